// The middle of a list of numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "ofm/base/check.h"

namespace ofm {

/// One of `values`: that in the middle, of an even number the larger of the two there. They must
/// not be empty.
template <class T>
T UpperMedian(std::vector<T> values) {
  OFM_CHECK(!values.empty());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace ofm
