#include "ofm/base/time.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "ofm/base/check.h"

namespace ofm {
namespace {

bool IsDigits(std::string_view text) {
  return text.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

std::optional<std::int64_t> ParseSeconds(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  const std::size_t dot = text.find('.');
  const std::string_view whole = text.substr(0, dot);
  std::string decimals(dot == std::string_view::npos ? "" : text.substr(dot + 1));
  if (whole.empty() || !IsDigits(whole) || !IsDigits(decimals) || whole.size() > 10) return {};
  decimals.resize(9, '0');
  std::int64_t seconds = 0, nanoseconds = 0;
  if (std::from_chars(whole.data(), whole.data() + whole.size(), seconds).ec != std::errc()) {
    return {};
  }
  if (seconds > 9'000'000'000) return {};
  std::from_chars(decimals.data(), decimals.data() + 9, nanoseconds);
  const std::int64_t stamp_ns = seconds * kNanosecondsPerSecond + nanoseconds;
  return negative ? -stamp_ns : stamp_ns;
}

std::string FormatSeconds(std::int64_t stamp_ns, int decimals) {
  OFM_CHECK(decimals >= 0 && decimals <= 9);
  std::uint64_t unit = 1;
  for (int i = decimals; i < 9; ++i) unit *= 10;
  // Unsigned: the magnitude of the least stamp, and of the largest when rounded up, fit there only.
  const auto bits = static_cast<std::uint64_t>(stamp_ns);
  const std::uint64_t magnitude = stamp_ns < 0 ? -bits : bits;
  const std::uint64_t rounded = (magnitude + unit / 2) / unit;
  const std::uint64_t per_second = kNanosecondsPerSecond / unit;
  const std::string sign = stamp_ns < 0 && rounded != 0 ? "-" : "";
  if (decimals == 0) return fmt::format("{}{}", sign, rounded);
  return fmt::format("{}{}.{:0{}}", sign, rounded / per_second, rounded % per_second, decimals);
}

std::int64_t SecondsToNanoseconds(double seconds) { return std::llround(seconds * 1e9); }

}  // namespace ofm
