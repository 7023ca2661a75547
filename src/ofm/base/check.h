// Checks of what only a programmer can get wrong.
#pragma once

#include <stdexcept>
#include <string>

namespace ofm {

[[noreturn]] inline void FailCheck(const char* condition, const char* file, int line) {
  throw std::logic_error(std::string(file) + ":" + std::to_string(line) +
                         ": check failed: " + condition);
}

}  // namespace ofm

/// Throws std::logic_error where `condition` is false.
#define OFM_CHECK(condition)                                            \
  do {                                                                  \
    if (!(condition)) ::ofm::FailCheck(#condition, __FILE__, __LINE__); \
  } while (false)
