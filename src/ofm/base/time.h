// Time is an integer number of nanoseconds since the epoch of the recording.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ofm {

inline constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

/// Reads decimal seconds ("1305031453.359684") exactly; empty where `text` is no such number or
/// would overflow. Digits beyond the ninth decimal are cut off.
std::optional<std::int64_t> ParseSeconds(std::string_view text);

/// Writes `stamp_ns` as decimal seconds with `decimals` digits (0 to 9), rounded half away from
/// zero.
std::string FormatSeconds(std::int64_t stamp_ns, int decimals = 6);

/// Nearest nanosecond.
std::int64_t SecondsToNanoseconds(double seconds);

inline double NanosecondsToSeconds(std::int64_t stamp_ns) {
  return static_cast<double>(stamp_ns) * 1e-9;
}

}  // namespace ofm
