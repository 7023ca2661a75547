// Growing masks along surfaces.
#pragma once

#include <opencv2/core/mat.hpp>

#include "ofm/perception/depth_range.h"

namespace ofm {

struct MaskGrowth {
  int distance_px = 8;  ///< pixels of the mask, at most
  int max_added = 0;    ///< pixels added, about, at most: whole rings, the nearest first
  float step_m = 0.05;  ///< between neighbours on one surface
  DepthRange range;     ///< outside it nothing is added
  cv::Mat free = {};    ///< CV_8UC1, not 0 = added whatever the distance and number; may be empty
};

/// Adds to `mask` (CV_8UC1) the pixels that are joined to it by at most distance_px steps between
/// 4-neighbours whose depths differ by at most step_m and are in the range; not what has no depth.
void GrowAlongDepth(const cv::Mat& depth_m, const MaskGrowth& growth, cv::Mat& mask);

}  // namespace ofm
