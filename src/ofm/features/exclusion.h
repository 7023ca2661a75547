// Where of an image no features are wanted.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "ofm/features/features.h"

namespace ofm {

/// Whether `excluded` (CV_8UC1; empty excludes nothing) is not 0 at the pixel nearest to `pixel`.
bool IsExcluded(const cv::Mat& excluded, const Eigen::Vector2f& pixel);

/// Takes the features off `features` that lie where `excluded` is not 0; the others keep their
/// order.
void EraseExcluded(const cv::Mat& excluded, Features& features);

}  // namespace ofm
