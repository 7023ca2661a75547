#include "ofm/io/read_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "ofm/base/error.h"

namespace ofm {

std::string ReadFile(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw Error(path, "does not exist; check the path");
  }
  if (std::filesystem::is_directory(status)) throw Error(path, "is a folder, not a file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) throw Error(path, fmt::format("cannot be opened: {}", std::strerror(errno)));

  std::string bytes;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (!ignored) bytes.reserve(size);
  char block[1 << 16];
  for (std::size_t count; (count = std::fread(block, 1, sizeof block, file.get())) > 0;) {
    bytes.append(block, count);
  }
  if (std::ferror(file.get())) {
    throw Error(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  }
  return bytes;
}

}  // namespace ofm
