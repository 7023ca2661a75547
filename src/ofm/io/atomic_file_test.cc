#include "ofm/io/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <ostream>
#include <stdexcept>
#include <thread>

#include "ofm/base/error.h"
#include "ofm/io/read_file.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using testing::HasSubstr;

/// No file can grow over `bytes` while it lives, as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_limit_);
    const rlimit limit{bytes, old_limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*old_handler_)(int);
  rlimit old_limit_{};
};

TEST(AtomicFile, MakesANewFileAndNothingElse) {
  const TestFolder folder;
  WriteFileAtomically(folder.path() / "a.txt", "hello\n");
  EXPECT_EQ(ReadFile(folder.path() / "a.txt"), "hello\n");
  EXPECT_EQ(folder.CountEntries(), 1u);
}

TEST(AtomicFile, StreamsMoreThanItsBuffer) {
  const TestFolder folder;
  std::string expected;
  WriteFileAtomically(folder.path() / "a.txt", [&](std::ostream& stream) {
    for (int i = 0; i < 50'000; ++i) {
      stream << i << '\n';
      expected += std::to_string(i) + "\n";
    }
  });
  EXPECT_EQ(ReadFile(folder.path() / "a.txt"), expected);
}

/// A process that writes the file again and again, each time full of another letter, until it is
/// killed as by kill -9.
class EndlessWriter {
 public:
  static constexpr std::size_t kBytes = 4'000'000;

  explicit EndlessWriter(const std::filesystem::path& path) : process_(fork()) {
    if (process_ == 0) WriteForever(path);
  }
  ~EndlessWriter() {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  EndlessWriter(const EndlessWriter&) = delete;
  EndlessWriter& operator=(const EndlessWriter&) = delete;

 private:
  /// Ends with the test at the latest.
  [[noreturn]] static void WriteForever(const std::filesystem::path& path) noexcept {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (char letter = 'a';; letter = letter == 'z' ? 'a' : static_cast<char>(letter + 1)) {
      WriteFileAtomically(path, std::string(kBytes, letter));
    }
  }

  pid_t process_;
};

TEST(AtomicFile, AProcessKilledAtAnyMomentLeavesAWholeFile) {
  const TestFolder folder;
  const std::filesystem::path path = folder.path() / "a.txt";
  WriteFileAtomically(path, std::string(EndlessWriter::kBytes, 'a'));
  for (int delay_ms = 1; delay_ms <= 20; ++delay_ms) {
    {
      const EndlessWriter writer(path);
      std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms));
    }
    const std::string contents = ReadFile(path);
    ASSERT_EQ(contents, std::string(EndlessWriter::kBytes, contents.at(0))) << delay_ms;
  }
}

TEST(AtomicFile, ReplacesAnOlderFileAndKeepsItsPermissions) {
  const TestFolder folder;
  const auto path = folder.Write("a.txt", "old and longer");
  ASSERT_EQ(chmod(path.c_str(), 0640), 0);
  WriteFileAtomically(path, "new");
  EXPECT_EQ(ReadFile(path), "new");
  struct stat info = {};
  ASSERT_EQ(stat(path.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777u, 0640u);
}

TEST(AtomicFile, LeavesTheOldFileWhereTheDiskIsFull) {
  const TestFolder folder;
  const auto path = folder.Write("a.txt", "old");
  const std::string large(200'000, 'x');
  std::string message;
  {
    const FileSizeLimit limit(4096);
    message = ErrorOf([&] { WriteFileAtomically(path, large); });
  }
  EXPECT_EQ(message, path.string() +
                         ": cannot be written: File too large; free some space or choose another "
                         "place");
  EXPECT_EQ(ReadFile(path), "old");
  EXPECT_EQ(folder.CountEntries(), 1u);
}

TEST(AtomicFile, LeavesTheOldFileWhereTheWriterThrows) {
  const TestFolder folder;
  const auto path = folder.Write("a.txt", "old");
  EXPECT_THROW(WriteFileAtomically(path,
                                   [](std::ostream& stream) {
                                     stream << "half";
                                     throw std::runtime_error("no more");
                                   }),
               std::runtime_error);
  EXPECT_EQ(ReadFile(path), "old");
  EXPECT_EQ(folder.CountEntries(), 1u);
}

TEST(AtomicFile, ReportsAStreamThatTheWriterLeftFailed) {
  const TestFolder folder;
  const auto path = folder.Write("a.txt", "old");
  const auto fail = [](std::ostream& stream) { stream.setstate(std::ios::failbit); };
  EXPECT_THAT(ErrorOf([&] { WriteFileAtomically(path, fail); }), HasSubstr("a.txt"));
  EXPECT_EQ(ReadFile(path), "old");
}

TEST(AtomicFile, ReportsAFullDeviceAndDoesNotReplaceIt) {
  if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_THAT(ErrorOf([] { WriteFileAtomically("/dev/full", "text"); }),
              HasSubstr("/dev/full: cannot be written: No space left on device"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(AtomicFile, ReplacesTheTargetOfALink) {
  const TestFolder folder;
  const auto target = folder.Write("target.txt", "old");
  const auto link = folder.path() / "link.txt";
  std::filesystem::create_symlink("target.txt", link);
  WriteFileAtomically(link, "new");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(ReadFile(target), "new");
}

TEST(AtomicFile, SaysWhatIsWrongWithTheFolder) {
  const TestFolder folder;
  const auto file = folder.Write("file", "");
  EXPECT_THAT(ErrorOf([&] { WriteFileAtomically(folder.path() / "none" / "a.txt", "x"); }),
              HasSubstr("none/a.txt: cannot be written: No such file or directory; create"));
  EXPECT_THAT(ErrorOf([&] { WriteFileAtomically(file / "a.txt", "x"); }),
              HasSubstr("file/a.txt: cannot be written: Not a directory"));
  EXPECT_THAT(ErrorOf([&] { WriteFileAtomically(folder.path(), "x"); }),
              HasSubstr("cannot be written: Is a directory"));
}

TEST(AtomicFile, TellsBeforehandWhetherItCanBeWritten) {
  const TestFolder folder;
  const auto file = folder.Write("file", "old");
  EXPECT_EQ(ErrorOf([&] { RequireWritable(folder.path() / "new"); }), "");
  EXPECT_EQ(ErrorOf([&] { RequireWritable(file); }), "");
  EXPECT_EQ(ReadFile(file), "old");
  EXPECT_EQ(folder.CountEntries(), 1u) << "it leaves nothing";
  EXPECT_EQ(ErrorOf([&] { RequireWritable(folder.path() / "none" / "a.txt"); }),
            ErrorOf([&] { WriteFileAtomically(folder.path() / "none" / "a.txt", "x"); }));
  EXPECT_THAT(ErrorOf([&] { RequireWritable(folder.path()); }), HasSubstr("Is a directory"));
}

TEST(AtomicFile, WritesBesideARelativeName) {
  const TestFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  WriteFileAtomically("a.txt", "here");
  std::filesystem::current_path(before);
  EXPECT_EQ(ReadFile(folder.path() / "a.txt"), "here");
}

}  // namespace
}  // namespace ofm
