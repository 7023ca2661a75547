// What the system saw and thought of a frame, as a picture.
#pragma once

#include <opencv2/core.hpp>

#include "ofm/pipeline/run_observer.h"

namespace ofm {

/// The frame (CV_8UC3, a copy) with instance masks outlined, their class and score, and the dynamic
/// mask in red.
cv::Mat DrawMasks(const PreparedFrame& prepared, const std::vector<std::string>& class_names);

/// Four pictures of the frame's size in one (CV_8UC3, twice as wide and high), as in the OFM-SLAM
/// paper's figures: upper left the frame with instance masks, their class and score, and the
/// dynamic mask in red; upper right the frame with what is dynamic set to 0 (Figure 3); lower left
/// the flow from the last frame (Figure 4); lower right the features (Figure 6): green those that
/// the pose is made of, blue other static ones, red points that were found moving.
cv::Mat DrawDebugView(const FrameReport& report, const std::vector<std::string>& class_names);

}  // namespace ofm
