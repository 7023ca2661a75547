// The camera's pose from points whose places are known: the inner loop of tracking.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "ofm/base/options.h"
#include "ofm/camera/pinhole_camera.h"
#include "ofm/estimation/observation.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

struct PoseOptimizerOptions {
  int rounds = 4;         ///< outliers are chosen anew after each
  int iterations = 10;    ///< at most, in each round
  double gate_scale = 1;  ///< multiplies the chi-square gates
  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("rounds", self.rounds, "rounds of optimisation; outliers are chosen anew after each",
          Range{1, 20});
    visit("iterations", self.iterations, "iterations at most in each round", Range{1, 100});
    visit("gate_scale", self.gate_scale, "multiplies the chi-square gates of outliers",
          Range{0.1, 100});
  }
};

/// A point of the map and where this frame saw it.
struct PoseObservation {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  PointObservation seen;
};

struct PoseEstimate {
  RigidTransform camera_from_world;
  std::vector<char> inlier;  ///< by observation; 1 = within the gate at the end
  int inlier_count = 0;
  bool converged = false;  ///< false where fewer than 3 inliers or a singular system
  /// Inverse of the covariance of the left perturbation (rho [m], omega [rad]) of
  /// camera_from_world.
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
};

/// Minimises the Huber-robustified (the last round: plain) sum of squared residuals over SE(3) by
/// Levenberg–Marquardt with analytic Jacobians, from `initial`. Rounds as published for ORB-SLAM2
/// (Mur-Artal and Tardos 2017): after each, observations over the chi-square gate (5.991; 7.815
/// with depth) sit out the next, and may come back. Points behind the camera are outliers.
PoseEstimate OptimizePose(const PinholeCamera& camera, const RigidTransform& initial,
                          std::span<const PoseObservation> observations,
                          const PoseOptimizerOptions& options);

}  // namespace ofm
