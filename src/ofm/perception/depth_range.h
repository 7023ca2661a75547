// The depths that belong to an object.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace ofm {

struct DepthRange {
  float near_m = 0, far_m = 0;

  bool Contains(float depth_m) const { return depth_m >= near_m && depth_m <= far_m; }
};

/// The depths of the largest cluster: neighbours in it differ by at most `margin_m`. Its range is
/// from its 10th to its 90th percentile, and `margin_m` on both sides; depths of 0 (not measured)
/// do not count. Empty where fewer than `min_count` were measured.
std::optional<DepthRange> FindDepthRange(std::vector<float> depths_m, double margin_m,
                                         std::size_t min_count);

/// Depths [m] under the set pixels of `mask` (CV_8UC1), of every `step`-th row and column;
/// `depth_m` is CV_32FC1 of its size.
std::vector<float> SampleDepths(const cv::Mat& mask, const cv::Mat& depth_m, int step);

/// Clears the pixels of `mask` whose depth was measured and is outside `range`.
void TrimToDepth(const cv::Mat& depth_m, const DepthRange& range, cv::Mat& mask);

}  // namespace ofm
