// Growing masks.
#pragma once

#include <opencv2/core/mat.hpp>

namespace ofm {

/// Sets to 255 in `mask` (CV_8UC1) what is within `radius_px` of a pixel of `object` (CV_8UC1 of
/// the same size, not 0 = object). The neighbourhood is cv::getStructuringElement's ellipse; the
/// result is cv::dilate's, for a fraction of the time: whole runs of pixels are written at once.
void AddDilated(const cv::Mat& object, int radius_px, cv::Mat& mask);

}  // namespace ofm
