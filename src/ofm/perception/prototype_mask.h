// The mask of one instance as a weighted sum of prototype masks (YOLACT, Bolya et al., ICCV 2019).
#pragma once

#include <opencv2/core/mat.hpp>

#include "ofm/perception/letterbox.h"

namespace ofm {

struct PrototypeMask {
  cv::Mat prototypes;    ///< CV_32FC1, M × (height · width), over the whole network input
  cv::Size size;         ///< of a prototype [px]
  cv::Mat coefficients;  ///< CV_32FC1, M × 1, continuous
};

/// CV_8UC1 of the image's size: 255 where sigmoid(coefficients · prototypes), interpolated
/// bilinearly at the pixel's centre, exceeds 1/2 and the pixel is in `box` (inside the image).
cv::Mat PastePrototypeMask(const PrototypeMask& mask, const Letterbox& letterbox,
                           const cv::Rect& box);

}  // namespace ofm
