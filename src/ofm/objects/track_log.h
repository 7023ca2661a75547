// Where what moves is, frame by frame.
#pragma once

#include <cstdint>
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/dynamics/dynamic_mask.h"
#include "ofm/geometry/trajectory.h"
#include "ofm/objects/object_options.h"
#include "ofm/objects/scene_object.h"

namespace ofm {

/// Median of the surface in `mask` (CV_8UC1): each coordinate's of every fourth pixel in both
/// directions [m], in the camera's frame. Empty where under 20 of these have depth.
std::optional<Eigen::Vector3d> MedianPoint(const cv::Mat& mask, const cv::Mat& depth_m,
                                           const PinholeCamera& camera);

/// Gathers the instances that dynamics follows; gives their tracks when the camera's trajectory is
/// known. Not thread-safe.
class TrackLog {
 public:
  TrackLog(const PinholeCamera& camera, const ObjectTrackOptions& options)
      : camera_(camera), options_(options) {}

  /// Frames come in increasing order of time.
  void Add(std::int64_t stamp_ns, const cv::Mat& depth_m,
           const std::vector<FollowedInstance>& instances);

  /// Tracks that last long enough, by id. Frames without a pose have no place in them. Speed is
  /// that of the way between the places half a window before and after, as far as there are some.
  std::vector<ObjectTrack> Build(const Trajectory& trajectory) const;

 private:
  struct Sample {
    std::int64_t stamp_ns = 0;
    ClassId class_id;
    float score = 0;
    Eigen::Vector3d position_in_camera;
  };

  PinholeCamera camera_;
  ObjectTrackOptions options_;
  std::map<InstanceId, std::vector<Sample>> samples_;
};

}  // namespace ofm
