// Axes: from values to pixels, and where the ticks are.
#pragma once

#include <string>
#include <vector>

namespace ofm {

/// `min` <= `max`.
struct Interval {
  double min = 0, max = 0;

  double length() const { return max - min; }
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// An empty interval, which the first call of Include fills.
Interval EmptyInterval();
bool IsEmpty(const Interval& interval);
/// Values that are not finite are left out.
void Include(Interval& interval, double value);
/// A little room on both sides; never of length 0, and [0, 1] where it was empty.
Interval Padded(const Interval& interval, double share);

/// Maps values to pixels linearly; `pixels` may run either way.
class LinearScale {
 public:
  LinearScale(const Interval& values, double pixel_of_min, double pixel_of_max)
      : values_(values),
        pixel_of_min_(pixel_of_min),
        px_per_unit_((pixel_of_max - pixel_of_min) / values.length()) {}

  double operator()(double value) const {
    return pixel_of_min_ + (value - values_.min) * px_per_unit_;
  }
  const Interval& values() const { return values_; }

 private:
  Interval values_;
  double pixel_of_min_, px_per_unit_;
};

/// Multiples of 1, 2 or 5 times a power of ten within the interval, which is not empty: about
/// `wanted` (at least 2) of them (P. Heckbert, Nice Numbers for Graph Labels, Graphics Gems, 1990).
std::vector<double> NiceTicks(const Interval& interval, int wanted);

/// A tick's text: as many decimals as the distance of the ticks needs, and never "-0".
std::string FormatTick(double value, double distance);

}  // namespace ofm
