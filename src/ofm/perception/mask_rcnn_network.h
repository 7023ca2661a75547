// A Mask R-CNN, whoever runs it.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "ofm/perception/mask_rcnn_decoder.h"

namespace ofm {

/// One object serves one thread at a time.
class MaskRcnnNetwork {
 public:
  virtual ~MaskRcnnNetwork() = default;

  /// How an image of this size is brought into the input.
  virtual Letterbox Fit(cv::Size image) const = 0;

  /// Runs the network on `image` (CV_8UC3, BGR, letterbox.image px). The masks are good until the
  /// next run. Throws Error that names the file where the network fails.
  virtual std::vector<MaskRcnnDetection> Detect(const cv::Mat& image,
                                                const Letterbox& letterbox) = 0;

  /// From its labels to CocoClassNames(). Throws Error where it was not trained on COCO.
  virtual ClassMap MapToCoco() const = 0;

  /// From its labels to a list of `class_count` names. Throws Error where it tells another number
  /// of classes apart.
  virtual ClassMap MapToNames(int class_count) const = 0;
};

}  // namespace ofm
