#include "ofm/io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <ostream>
#include <streambuf>

#include "ofm/base/error.h"

namespace ofm {
namespace {

namespace fs = std::filesystem;

/// Buffers bytes for a file descriptor, which it owns, and remembers the first failure.
class DescriptorBuffer : public std::streambuf {
 public:
  explicit DescriptorBuffer(int descriptor) : descriptor_(descriptor) { Reset(); }
  ~DescriptorBuffer() override {
    if (descriptor_ >= 0) close(descriptor_);
  }
  DescriptorBuffer(const DescriptorBuffer&) = delete;
  DescriptorBuffer& operator=(const DescriptorBuffer&) = delete;

  int descriptor() const { return descriptor_; }
  /// errno of the first failed call, 0 while all is well.
  int error() const { return error_; }

  /// Nothing can be written after it.
  void Close() {
    if (close(descriptor_) != 0) Fail();
    descriptor_ = -1;
  }
  void Fail() {
    if (error_ == 0) error_ = errno;
  }

 protected:
  int sync() override {
    const char* next = pbase();
    while (next < pptr() && error_ == 0) {
      const ssize_t count = ::write(descriptor_, next, static_cast<std::size_t>(pptr() - next));
      if (count >= 0) {
        next += count;
      } else if (errno != EINTR) {
        Fail();
      }
    }
    Reset();
    return error_ == 0 ? 0 : -1;
  }
  int_type overflow(int_type c) override {
    if (sync() != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
  }

 private:
  void Reset() { setp(buffer_.data(), buffer_.data() + buffer_.size()); }

  int descriptor_;
  int error_ = 0;
  std::array<char, 1 << 16> buffer_;
};

[[noreturn]] void ThrowNotWritten(const fs::path& path, int error) {
  const char* const advice = error == ENOENT || error == ENOTDIR ? "create its folder first"
                             : error == ENOSPC || error == EDQUOT || error == EFBIG
                                 ? "free some space or choose another place"
                                 : "choose a place that can be written";
  throw Error(path, fmt::format("cannot be written: {}; {}", std::strerror(error), advice));
}

/// Runs `write` and brings all its bytes to the disk.
void WriteAll(const fs::path& path, DescriptorBuffer& buffer,
              const std::function<void(std::ostream&)>& write) {
  std::ostream stream(&buffer);
  write(stream);
  stream.flush();
  // What cannot be synchronised (a pipe, a terminal) answers EINVAL or ENOTSUP.
  if (buffer.error() == 0 && fsync(buffer.descriptor()) != 0 && errno != EINVAL &&
      errno != ENOTSUP && errno != EROFS) {
    buffer.Fail();
  }
  buffer.Close();
  if (buffer.error() != 0) ThrowNotWritten(path, buffer.error());
  if (!stream) throw Error(path, "cannot be written: its contents could not be produced");
}

void WriteDirectly(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  DescriptorBuffer buffer(open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (buffer.descriptor() < 0) ThrowNotWritten(path, errno);
  WriteAll(path, buffer, write);
}

/// A file beside `path` that goes away unless it is renamed to it.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& path) : target_(path) {
    for (int attempt = 0; descriptor_ < 0; ++attempt) {
      name_ = path.parent_path() /
              fmt::format(".{}.{}-{}.tmp", path.filename().string(), getpid(), attempt);
      descriptor_ = open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ < 0 && errno != EEXIST) ThrowNotWritten(path, errno);
    }
  }
  ~TemporaryFile() {
    if (!renamed_) unlink(name_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  int descriptor() const { return descriptor_; }

  void Rename() {
    if (rename(name_.c_str(), target_.c_str()) != 0) ThrowNotWritten(target_, errno);
    renamed_ = true;
  }

 private:
  fs::path target_, name_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

/// Where the bytes for `path` go in the end: the target of a link.
fs::path ResolveTarget(const fs::path& path) {
  std::error_code failed;
  const fs::path resolved = fs::weakly_canonical(path, failed);
  return failed ? path : resolved;
}

/// Makes a rename in `folder` last; file systems that cannot are no error.
void SyncFolder(const fs::path& folder) {
  const int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

}  // namespace

void WriteFileAtomically(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  struct stat old = {};
  const bool exists = stat(path.c_str(), &old) == 0;
  if (exists && S_ISDIR(old.st_mode)) ThrowNotWritten(path, EISDIR);
  if (exists && !S_ISREG(old.st_mode)) return WriteDirectly(path, write);

  const fs::path target = ResolveTarget(path);
  TemporaryFile temporary(target);
  DescriptorBuffer buffer(temporary.descriptor());
  if (exists && fchmod(buffer.descriptor(), old.st_mode & 07777) != 0) buffer.Fail();
  WriteAll(path, buffer, write);
  temporary.Rename();
  SyncFolder(target.parent_path());
}

void WriteFileAtomically(const fs::path& path, std::string_view contents) {
  WriteFileAtomically(path, [&](std::ostream& stream) {
    stream.write(contents.data(), static_cast<std::streamsize>(contents.size()));
  });
}

void RequireWritable(const fs::path& path) {
  struct stat old = {};
  const bool exists = stat(path.c_str(), &old) == 0;
  if (exists && S_ISDIR(old.st_mode)) ThrowNotWritten(path, EISDIR);
  if (exists && !S_ISREG(old.st_mode)) return;
  const TemporaryFile probe(ResolveTarget(path));
  close(probe.descriptor());
}

}  // namespace ofm
