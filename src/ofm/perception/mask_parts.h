// Connected parts of masks and the holes in them.
#pragma once

#include <opencv2/core/mat.hpp>

namespace ofm {

/// Clears the 8-connected parts of `mask` (CV_8UC1, 255 = object) that have fewer pixels than
/// `min_share` of the largest. Returns the number of pixels left.
int KeepLargestParts(double min_share, cv::Mat& mask);

/// Sets the holes of at most `max_area` pixels; what is open to the mask's border is no hole.
void CloseHoles(int max_area, cv::Mat& mask);

}  // namespace ofm
