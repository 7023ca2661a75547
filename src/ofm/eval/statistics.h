// Statistics of errors.
#pragma once

#include <cstddef>
#include <span>

namespace ofm {

/// In the unit of the errors. The standard deviation is the population's (divided by n), as numpy's
/// and the TUM RGB-D benchmark's; the median of an even number is the mean of the middle two.
struct ErrorStatistics {
  std::size_t count = 0;
  double rmse = 0, mean = 0, median = 0, std = 0, min = 0, max = 0;
};

/// All zero for an empty list.
ErrorStatistics ComputeStatistics(std::span<const double> errors);

}  // namespace ofm
