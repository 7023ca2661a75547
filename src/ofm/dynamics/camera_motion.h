// The camera's own motion between two frames: a cheap pose first, to tell what moves by itself.
#pragma once

#include <opencv2/core.hpp>

#include "ofm/base/random.h"
#include "ofm/dynamics/motion_options.h"
#include "ofm/geometry/rigid_transform.h"
#include "ofm/perception/lattice_frame.h"

namespace ofm {

/// Two frames and the flow between them, all on the lattice.
struct LatticePair {
  const LatticeFrame& current;
  const LatticeFrame& last;
  const cv::Mat&
      flow;  ///< CV_32FC2 per cell of `current`: where it was in `last`, relative [cells]
  const cv::Mat& belief;  ///< CV_32FC1 per cell of `current`: log-odds of moving, as expected
};

struct CameraMotion {
  RigidTransform last_from_current;
  double inlier_share = 0;   ///< of the points used
  bool is_measured = false;  ///< false: the prediction, for lack of points or of agreement
  /// Enough points, but hardly any agree: the camera did anything but move as predicted.
  bool is_contradicted = false;
};

/// The pose of the last camera in the current one's frame from points of `pair.current` that have
/// depth and texture and are believed static, one of each block, and their flow. OptimizePose from
/// `predicted`; RANSAC is asked too where few agree.
CameraMotion EstimateCameraMotion(const PinholeCamera& lattice_camera, const LatticePair& pair,
                                  const RigidTransform& predicted, const MotionOptions& options,
                                  RandomEngine& engine);

}  // namespace ofm
