// How an image gets into a Mask R-CNN: its size and its numbers.
#pragma once

#include <opencv2/core/mat.hpp>

#include "ofm/perception/letterbox.h"

namespace ofm {

/// The size to which an image is brought. It is scaled by one factor into the input's upper left
/// corner; what is left over at the right and below is padding.
struct MaskRcnnInputSize {
  /// The input, where the network's file or the user fixes it; empty = by the rest.
  cv::Size fixed = {};
  int shorter_side = 800;        ///< wanted of the scaled image [px]; 0 = the image is not scaled
  cv::Size most = {1333, 1333};  ///< the scaled image is no larger than this [px]
  int multiple = 1;              ///< both sides of the input are padded to a multiple of this [px]
};

/// The image must not be empty.
Letterbox FitMaskRcnnInput(cv::Size image, const MaskRcnnInputSize& size);

/// What a network was trained on.
struct MaskRcnnColors {
  enum class Order { kRgb, kBgr } order = Order::kRgb;
  cv::Scalar mean = {};  ///< subtracted from 0 … 255, in the order of the channels
  double scale = 1;      ///< after that
};

/// CV_32F, 3 × height × width of letterbox.input; the padding is 0. `image`: CV_8UC3, BGR,
/// letterbox.image px.
cv::Mat MakeMaskRcnnBlob(const Letterbox& letterbox, const cv::Mat& image,
                         const MaskRcnnColors& colors);

}  // namespace ofm
