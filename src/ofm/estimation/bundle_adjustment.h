// Keyframe poses and landmarks together, by Ceres with the Schur complement.
#pragma once

#include <Eigen/Core>
#include <stop_token>
#include <vector>

#include "ofm/base/options.h"
#include "ofm/camera/pinhole_camera.h"
#include "ofm/estimation/bundle_problem.h"
#include "ofm/estimation/depth_vetting.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

struct BundleOptions {
  int robust_iterations = 5;  ///< with Huber; then outliers leave
  int final_iterations = 10;  ///< without Huber, on the inliers
  int threads = 1;            ///< of Ceres; 1 is bit-reproducible
  DepthVettingOptions depth_vetting = {};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("robust_iterations", self.robust_iterations, "iterations with the robust kernel",
          Range{1, 200});
    visit("final_iterations", self.final_iterations, "iterations on the inliers after that",
          Range{0, 200});
    visit("threads", self.threads, "threads of the solver; 1 is bit-reproducible", Range{1, 64});
    visit("depth_vetting", self.depth_vetting);
  }
};

struct BundleResult {
  std::vector<RigidTransform> camera_from_world;  ///< by pose
  std::vector<Eigen::Vector3d> points_in_world;   ///< by point
  std::vector<char> inlier;                 ///< by observation; 1 = within the gate at the end
  double initial_cost = 0, final_cost = 0;  ///< half the sum of squared robust residuals
  bool usable = false;                      ///< false where the solver failed or was stopped early
};

/// Robust iterations, removal of observations over the chi-square gate, final iterations. Depths
/// that parallax contradicts, at the start and again after the robust iterations, are left out;
/// their pixels stay. Where `stop` is requested the best state so far is given back with usable =
/// false.
BundleResult AdjustBundle(const PinholeCamera& camera, const BundleProblem& problem,
                          const BundleOptions& options, std::stop_token stop = {});

}  // namespace ofm
