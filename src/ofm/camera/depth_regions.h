// Surfaces in a depth image.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace ofm {

/// Pixels that are joined by small depth steps.
struct DepthRegion {
  std::vector<cv::Point> pixels;
};

/// Parts of `mask` (CV_8UC1, not 0 = looked at) whose 4-neighbours differ in depth (CV_32FC1 [m])
/// by at most `step_m`. Pixels without depth belong to no part. In the order of their first pixels.
std::vector<DepthRegion> FindDepthRegions(const cv::Mat& mask, const cv::Mat& depth_m,
                                          float step_m);

}  // namespace ofm
