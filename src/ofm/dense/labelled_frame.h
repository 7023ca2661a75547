// What the semantic map is made of: a frame's images with a label per pixel.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "ofm/base/ids.h"
#include "ofm/geometry/rigid_transform.h"
#include "ofm/perception/label_image.h"

namespace ofm {

/// Images of one frame, all of one size: the camera's, or every n-th pixel of every n-th row. The
/// images are shared, not copied.
struct LabelledFrame {
  KeyframeId id;  ///< invalid where the frame is no key frame
  /// Into the key frame's camera, from the camera when the depth image was taken.
  RigidTransform keyframe_from_depth;
  cv::Mat color;         ///< CV_8UC3, BGR
  cv::Mat depth_m;       ///< CV_32FC1 [m], 0 = not measured
  cv::Mat class_ids;     ///< CV_8UC1, ClassId of each pixel, kNoLabel = none; may be empty
  cv::Mat confidence;    ///< CV_8UC1, of the label, 255 = sure; empty where class_ids is
  cv::Mat dynamic_mask;  ///< CV_8UC1, 255 = moves; may be empty
  cv::Mat instances;     ///< CV_16UC1, a number within the frame, kNoInstance = none; may be empty
  std::int64_t stamp_ns = 0;
};

}  // namespace ofm
