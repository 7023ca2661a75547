#include "ofm/base/error.h"

#include <fmt/format.h>

namespace ofm {

Error::Error(const std::string& message) : std::runtime_error(message) {}

Error::Error(const std::filesystem::path& path, const std::string& message)
    : std::runtime_error(fmt::format("{}: {}", path.string(), message)), path_(path) {}

Error::Error(const std::filesystem::path& path, int line, const std::string& message)
    : std::runtime_error(fmt::format("{}:{}: {}", path.string(), line, message)),
      path_(path),
      line_(line) {}

}  // namespace ofm
