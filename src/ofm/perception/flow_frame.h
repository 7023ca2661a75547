// What carrying masks needs of a frame.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "ofm/perception/optical_flow.h"

namespace ofm {

/// Copies share the images.
struct FlowFrame {
  FlowPyramid pyramid;
  cv::Mat depth_m;            ///< CV_32FC1 [m] of the pyramid's size, 0 = not measured
  std::int64_t stamp_ns = 0;  ///< of the colour image
};

}  // namespace ofm
