// The current frame as people want to see it.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "ofm/pipeline/run_observer.h"

namespace ofm {

/// What is to be drawn of a frame; values that live on after its FrameReport.
struct LivePicture {
  PreparedFrame prepared;
  std::vector<bool> in_pose;  ///< by feature: the pose is made of it
};

/// The frame (CV_8UC3, a copy) with the dynamic mask in red, instances outlined and named, features
/// of the pose in green, other static ones in blue.
cv::Mat DrawLivePicture(const LivePicture& picture, const std::vector<std::string>& class_names);

}  // namespace ofm
