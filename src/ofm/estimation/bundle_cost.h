// What bundle adjustment gives to Ceres: residual, robust kernel, and the manifold of rotations.
#pragma once

#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/sized_cost_function.h>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/estimation/observation.h"

namespace ofm {

/// ReprojectionResidual times the root of the weight, of three parameter blocks:
///   the point in the world [m], the rotation of camera_from_world as a unit quaternion
///   (x, y, z, w), its translation [m].
/// Derivatives by the rotation are those by omega in Exp(omega) * rotation, in the first three of
/// the block's four columns; the fourth is zero. LeftRotationManifold takes them so.
/// A point that is not before the camera has a large constant residual.
/// The third residual is there without depth too, as 0: rows of one size, and blocks of three
/// columns each, are what Ceres has unrolled code for.
class ReprojectionCost final : public ceres::SizedCostFunction<3, 3, 4, 3> {
 public:
  ReprojectionCost(const PinholeCamera& camera, const PointObservation& seen);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  double u_, v_, inverse_depth_;            ///< measured, in the normalised image [1, 1, 1/m]
  double u_scale_, v_scale_, depth_scale_;  ///< 1 / standard deviation of these, times root of w
};

/// Huber's kernel whose threshold is the root of the observation's gate, for residuals that the
/// root of the weight was multiplied to.
class GateHuberLoss final : public ceres::LossFunction {
 public:
  explicit GateHuberLoss(const PointObservation& seen);

  void Evaluate(double squared_norm, double rho[3]) const override;

 private:
  double squared_threshold_;
};

/// Unit quaternions (x, y, z, w) with Plus(q, omega) = Exp(omega) * q. Only for cost functions that
/// differentiate by omega themselves: its PlusJacobian picks their first three columns.
class LeftRotationManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 4; }
  int TangentSize() const override { return 3; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  /// Not needed by the solver; always fails.
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

}  // namespace ofm
