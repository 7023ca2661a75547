// A key frame as a small labelled cloud.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/dense/dense_options.h"
#include "ofm/dense/labelled_frame.h"
#include "ofm/dense/labelled_point.h"
#include "ofm/dense/semantic_octree.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// What a key frame gives to the map, in its camera's frame: it stays good whatever becomes of the
/// key frame's pose.
struct KeyframeCloud {
  std::vector<LabelledPoint> points_in_camera;
  /// Ends, at the range limit, of the rays to points beyond it: they free and fill nothing [m].
  std::vector<Eigen::Vector3f> free_ends_in_camera;
};

/// By key frame; shared, so that other threads can read them.
using KeyframeClouds = std::map<KeyframeId, std::shared_ptr<const KeyframeCloud>>;

/// world_from_camera of key frames.
using KeyframePoseMap = std::map<KeyframeId, RigidTransform>;

/// A key frame's cloud where `world_from_camera` puts it.
WorldScan TransformToWorld(const KeyframeCloud& cloud, const RigidTransform& world_from_camera);

/// Makes clouds for one camera. The range is the distance from the camera, not z.
class KeyframeCloudMaker {
 public:
  /// Throws Error where an option is out of its range.
  KeyframeCloudMaker(const PinholeCamera& camera, const DenseOptions& options);

  /// Back-projects the usable pixels (usable_pixels.h) but loose pieces (loose_pieces.h), lens
  /// distortion undone, and keeps one point per voxel of CloudResolution(). `views` are frames from
  /// nearby, for what the key frame does not show and to tell what moves in it.
  KeyframeCloud Make(const LabelledFrame& keyframe,
                     std::span<const LabelledFrame> views = {}) const;

 private:
  struct Gathered;
  std::vector<cv::Mat> FindUsable(std::span<const LabelledFrame> frames) const;
  void Gather(const LabelledFrame& frame, const cv::Mat& usable, Gathered& gathered) const;

  PinholeCamera camera_;
  DenseOptions options_;
  std::vector<Eigen::Vector2f> rays_;  // (x, y) of the point at z = 1 m behind each pixel
};

}  // namespace ofm
