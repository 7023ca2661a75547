// Instances of known classes in an image.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ofm/base/ids.h"

namespace ofm {

/// One object that a segmenter saw.
struct Instance {
  InstanceId id;     ///< number within its frame, or the mask file's number
  ClassId class_id;  ///< index into the segmenter's class names
  float score = 0;   ///< confidence, 0 to 1
  cv::Rect box;      ///< [px], inside the image
  cv::Mat mask;      ///< CV_8UC1 of the image's size, 255 = the object
};

/// All instances of one frame, the most confident first.
struct Segmentation {
  FrameId frame_id;
  std::vector<Instance> instances;
  /// Frames since the one that the network saw; 0 = this one, empty = there was none to go by.
  std::optional<int> age_frames = 0;
};

}  // namespace ofm
