#include "ofm/eval/statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ofm {
namespace {

double Median(std::vector<double> values) {
  const std::size_t half = values.size() / 2;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(half);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

}  // namespace

ErrorStatistics ComputeStatistics(std::span<const double> errors) {
  ErrorStatistics statistics;
  if (errors.empty()) return statistics;
  const double count = static_cast<double>(errors.size());
  double sum = 0, sum_of_squares = 0;
  for (const double error : errors) {
    sum += error;
    sum_of_squares += error * error;
  }
  statistics.count = errors.size();
  statistics.mean = sum / count;
  statistics.rmse = std::sqrt(sum_of_squares / count);
  double variance = 0;
  for (const double error : errors) {
    variance += (error - statistics.mean) * (error - statistics.mean) / count;
  }
  statistics.std = std::sqrt(variance);
  statistics.median = Median({errors.begin(), errors.end()});
  const auto [min, max] = std::minmax_element(errors.begin(), errors.end());
  statistics.min = *min;
  statistics.max = *max;
  return statistics;
}

}  // namespace ofm
