// What moves in a frame.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "ofm/base/ids.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// The camera's motion from one frame to the next.
struct FrameMotion {
  std::int64_t last_stamp_ns = 0;  ///< of the frame before
  RigidTransform current_from_last;
};

/// Where a point was and is, for people to look at.
struct FlowVector {
  Eigen::Vector2f last_px, current_px;
  bool is_moving = false;  ///< against the camera's motion
};

/// An instance of a class that may move, under an id that it keeps from frame to frame.
struct FollowedInstance {
  InstanceId id;  ///< never used twice
  ClassId class_id;
  float score = 0;  ///< of the last detection, less where that is longer ago
  cv::Mat mask;     ///< CV_8UC1 of the image's size, 255 = the instance; shared, not copied
};

/// Where a frame must not be trusted, and the points that told so.
struct DynamicMask {
  cv::Mat mask;      ///< CV_8UC1 of the image's size, 255 = dynamic
  cv::Mat unmapped;  ///< CV_8UC1, 255 = keep out of dense maps: also what may move; empty = mask
  std::vector<Eigen::Vector2f> dynamic_points;  ///< [px] found moving by optical flow
  cv::Mat static_probability;                   ///< CV_8UC1, 255 = surely; empty = not told
  std::vector<FlowVector> flow;                 ///< of some points
  std::optional<FrameMotion> camera_motion;     ///< where the flow tells it
  std::vector<FollowedInstance> followed;       ///< by id; mode `full`
  double masked_share = 0;                      ///< of the image's pixels, 0 to 1
};

}  // namespace ofm
