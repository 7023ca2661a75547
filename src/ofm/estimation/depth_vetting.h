// Which points have a depth that parallax contradicts: corners on silhouettes, above all, that get
// the depth of what is behind them.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "ofm/base/options.h"
#include "ofm/camera/pinhole_camera.h"
#include "ofm/estimation/bundle_problem.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// The limit is for real recordings, where depth stamped late and blurred colour add to all
/// residuals: 0.01 1/m condemns good depths there, and is better only in the simulator
/// (docs/results.md).
struct DepthVettingOptions {
  double max_residual = 0.02;        ///< [1/m]
  double max_parallax_sigma = 0.02;  ///< [1/m]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("max_residual", self.max_residual,
          "of a point's inverse depth, measured less triangulated, on the mean; over it its depth "
          "is not used [1/m]",
          Range{1e-6, 1e6});
    visit("max_parallax_sigma", self.max_parallax_sigma,
          "standard deviation of the inverse depth by parallax; over it the measured one is "
          "believed [1/m]",
          Range{1e-6, 1e6});
  }
};

/// True by point where the poses of its observers tell its inverse depth well enough, and what they
/// measured is off by more than the limit on the mean. Measured against the scale that most
/// observations have, so that a map which is too large as a whole does not condemn all depths.
/// One contradicted depth does little, but those of silhouettes all err to the same side: without
/// this the way of a camera around a desk comes out 0.5 to 1.6 % too long (docs/results.md).
std::vector<char> FindContradictedDepths(const PinholeCamera& camera,
                                         std::span<const RigidTransform> camera_from_world,
                                         std::span<const Eigen::Vector3d> points_in_world,
                                         std::span<const BundleProblem::Observation> observations,
                                         const DepthVettingOptions& options);

}  // namespace ofm
