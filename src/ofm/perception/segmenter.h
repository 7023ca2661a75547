// The interface of everything that finds instances in a frame.
#pragma once

#include <string>
#include <vector>

#include "ofm/camera/rgbd_frame.h"
#include "ofm/perception/segmentation.h"

namespace ofm {

/// Finds instances of known classes in a frame. One object serves one thread.
class Segmenter {
 public:
  virtual ~Segmenter() = default;

  /// Instances in `frame`; throws Error where the frame's masks cannot be had.
  virtual Segmentation Segment(const RgbdFrame& frame) = 0;

  /// Names by ClassId.
  virtual const std::vector<std::string>& class_names() const = 0;
};

}  // namespace ofm
