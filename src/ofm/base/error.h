// The one exception type for bad input, files and settings.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

namespace ofm {

/// Bad input: what() is one line, "path:line: message", which names the file (and line) at fault
/// and says what to do. A programmer's error throws std::logic_error instead (see check.h).
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message);
  Error(const std::filesystem::path& path, const std::string& message);
  /// `line` counts from 1.
  Error(const std::filesystem::path& path, int line, const std::string& message);

  const std::filesystem::path& path() const { return path_; }
  std::optional<int> line() const { return line_; }

 private:
  std::filesystem::path path_;
  std::optional<int> line_;
};

}  // namespace ofm
