// How one camera stands to another, from points that both have measured: what a loop is proved by.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "ofm/base/random.h"
#include "ofm/camera/pinhole_camera.h"
#include "ofm/estimation/observation.h"
#include "ofm/estimation/ransac.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// A point of the source camera and the one of the target camera that it was matched with. Of each
/// the place in its camera [m] and how that camera saw it.
struct PointPair {
  Eigen::Vector3d point_in_source = Eigen::Vector3d::Zero();
  Eigen::Vector3d point_in_target = Eigen::Vector3d::Zero();
  PointObservation seen_in_source, seen_in_target;
};

struct PairAlignment {
  RigidTransform target_from_source;
  std::vector<char> inlier;  ///< by pair; 1 = reprojects within the gates in both images
  int inlier_count = 0;
};

/// RANSAC over three pairs (closed-form alignment, AlignRigid; the scale is known). A pair is an
/// inlier where its source point is within the chi-square gate of what the target saw, and its
/// target point of what the source saw. The best pose is refined on its inliers. Empty where no
/// pose has `min_inliers` (at least 3).
std::optional<PairAlignment> AlignPairsRansac(const PinholeCamera& camera,
                                              std::span<const PointPair> pairs, int min_inliers,
                                              const RansacLimits& limits, RandomEngine& engine);

}  // namespace ofm
