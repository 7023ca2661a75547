// A cloud of landmarks seen by a moving camera, without images: the test world of estimators.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "ofm/base/ids.h"
#include "ofm/camera/pinhole_camera.h"
#include "ofm/geometry/trajectory.h"
#include "ofm/sim/camera_path.h"

namespace ofm {

struct LandmarkWorldOptions {
  std::uint64_t seed = 1;
  int landmarks = 500;
  int frames = 30;
  double rate_hz = 10;
  PinholeCamera camera;
  CameraPathOptions path;
  double max_depth_m = 8;    ///< farther landmarks are not seen
  double pixel_sigma = 0;    ///< of each pixel coordinate [px]
  double depth_sigma = 0;    ///< sigma of depth = this times z^2 [1/m]; Kinect: 1.4e-3
  double outlier_share = 0;  ///< of the observations: a random pixel and depth instead
};

/// One landmark in one frame.
struct LandmarkObservation {
  LandmarkId landmark;
  Eigen::Vector2d ideal_px;  ///< without distortion
  double depth_m = 0;
  bool is_outlier = false;
};

/// Landmarks scattered over a box of 6 x 4 x 2.6 m before and around the camera's view. Immutable.
class LandmarkWorld {
 public:
  explicit LandmarkWorld(const LandmarkWorldOptions& options);

  const PinholeCamera& camera() const { return options_.camera; }
  /// By LandmarkId.
  const std::vector<Eigen::Vector3d>& landmarks_in_world() const { return landmarks_; }
  std::size_t frame_count() const { return static_cast<std::size_t>(options_.frames); }
  StampedPose Pose(FrameId id) const;
  /// What frame `id` sees, in order of the landmarks; noise is decided by (seed, id).
  std::vector<LandmarkObservation> Observe(FrameId id) const;

 private:
  LandmarkWorldOptions options_;
  CameraPath path_;
  std::vector<Eigen::Vector3d> landmarks_;
};

}  // namespace ofm
