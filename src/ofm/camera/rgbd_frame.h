// One registered colour and depth image.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>

#include "ofm/base/ids.h"

namespace ofm {

/// Colour and depth of the same size, depth registered to colour. The images are not written to
/// once the frame is made: stages share them.
struct RgbdFrame {
  FrameId id;
  std::string name;           ///< stem of the colour file, by which masks are found; may be empty
  std::int64_t stamp_ns = 0;  ///< of the colour image
  std::int64_t depth_stamp_ns = 0;  ///< of the depth image
  cv::Mat color;                    ///< CV_8UC3, BGR
  cv::Mat gray;                     ///< CV_8UC1
  cv::Mat depth_m;                  ///< CV_32FC1 [m], 0 = not measured
};

}  // namespace ofm
