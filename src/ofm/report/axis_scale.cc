#include "ofm/report/axis_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ofm/base/check.h"

namespace ofm {
namespace {

/// 1, 2, 5 or 10 times a power of ten, the nearest to `value`.
double NearestNice(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  const double fraction = value / power;
  if (fraction < 1.5) return power;
  if (fraction < 3) return 2 * power;
  return fraction < 7 ? 5 * power : 10 * power;
}

}  // namespace

Interval EmptyInterval() {
  return {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
}

bool IsEmpty(const Interval& interval) { return interval.min > interval.max; }

void Include(Interval& interval, double value) {
  if (!std::isfinite(value)) return;
  interval.min = std::min(interval.min, value);
  interval.max = std::max(interval.max, value);
}

Interval Padded(const Interval& interval, double share) {
  if (IsEmpty(interval)) return {0, 1};
  // What is too narrow for its values' own precision would have no ticks.
  const double magnitude = std::max(std::abs(interval.min), std::abs(interval.max));
  const double least = std::max(1e-9 * magnitude, 1e-9);
  if (interval.length() < least) {
    const double half = magnitude > 0 ? 0.1 * magnitude : 0.5;
    return {interval.min - half, interval.max + half};
  }
  const double room = share * interval.length();
  return {interval.min - room, interval.max + room};
}

std::vector<double> NiceTicks(const Interval& interval, int wanted) {
  OFM_CHECK(wanted >= 2 && interval.length() > 0 && std::isfinite(interval.length()));
  const double step = NearestNice(interval.length() / (wanted - 1));
  const double slack = 1e-9 * interval.length();
  std::vector<double> ticks;
  for (double i = std::ceil((interval.min - slack) / step); i * step <= interval.max + slack; ++i) {
    ticks.push_back(i * step);
  }
  return ticks;
}

std::string FormatTick(double value, double distance) {
  if (std::abs(value) < 1e-6 * distance) return "0";
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(distance) + 1e-6)));
  if (decimals > 6 || std::abs(value) >= 1e7) return fmt::format("{:.3g}", value);
  return fmt::format("{:.{}f}", value, decimals);
}

}  // namespace ofm
