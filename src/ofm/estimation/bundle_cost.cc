#include "ofm/estimation/bundle_cost.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "ofm/estimation/reprojection.h"

namespace ofm {
namespace {

/// Root of the chi-square in place of infinity; see PoseSystem.
constexpr double kBehindResidual = 1e3;

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

void FailBehind(double* residuals, double** jacobians) {
  residuals[0] = kBehindResidual, residuals[1] = residuals[2] = 0;
  if (jacobians == nullptr) return;
  if (jacobians[0] != nullptr) Eigen::Map<RowMajor3>(jacobians[0]).setZero();
  if (jacobians[1] != nullptr) Eigen::Map<RowMajor34>(jacobians[1]).setZero();
  if (jacobians[2] != nullptr) Eigen::Map<RowMajor3>(jacobians[2]).setZero();
}

}  // namespace

ReprojectionCost::ReprojectionCost(const PinholeCamera& camera, const PointObservation& seen)
    : u_((seen.ideal_px.x() - camera.cx) / camera.fx),
      v_((seen.ideal_px.y() - camera.cy) / camera.fy),
      inverse_depth_(HasDepth(seen) ? 1 / seen.depth_m : 0) {
  const double root = std::sqrt(seen.weight);
  u_scale_ = root * camera.fx / seen.pixel_sigma;
  v_scale_ = root * camera.fy / seen.pixel_sigma;
  depth_scale_ = HasDepth(seen) ? root / seen.inverse_depth_sigma : 0;
}

bool ReprojectionCost::Evaluate(double const* const* parameters, double* residuals,
                                double** jacobians) const {
  const Eigen::Map<const Eigen::Vector3d> point(parameters[0]);
  const Eigen::Map<const Eigen::Quaterniond> quaternion(parameters[1]);
  const Eigen::Map<const Eigen::Vector3d> translation(parameters[2]);
  const Eigen::Matrix3d rotation = quaternion.toRotationMatrix();
  const Eigen::Vector3d rotated = rotation * point;
  const Eigen::Vector3d in_camera = rotated + translation;
  if (!IsBeforeCamera(in_camera)) {
    FailBehind(residuals, jacobians);
    return true;
  }
  const double q = 1 / in_camera.z();
  const double a = in_camera.x() * q, b = in_camera.y() * q;
  residuals[0] = u_scale_ * (u_ - a);
  residuals[1] = v_scale_ * (v_ - b);
  residuals[2] = depth_scale_ * (inverse_depth_ - q);
  if (jacobians == nullptr) return true;

  RowMajor3 by_translation;
  by_translation << -u_scale_ * q, 0, u_scale_ * a * q,  //
      0, -v_scale_ * q, v_scale_ * b * q,                //
      0, 0, depth_scale_ * q * q;
  if (jacobians[0] != nullptr) {
    Eigen::Map<RowMajor3>(jacobians[0]).noalias() = by_translation * rotation;
  }
  if (jacobians[1] != nullptr) {
    // Row i times -skew(rotated) is rotated x row i.
    Eigen::Map<RowMajor34> by_rotation(jacobians[1]);
    for (int i = 0; i < 3; ++i) {
      by_rotation.row(i).head<3>() = rotated.cross(by_translation.row(i).transpose());
    }
    by_rotation.col(3).setZero();
  }
  if (jacobians[2] != nullptr) Eigen::Map<RowMajor3>{jacobians[2]} = by_translation;
  return true;
}

GateHuberLoss::GateHuberLoss(const PointObservation& seen)
    : squared_threshold_(ChiSquareGate(seen) * seen.weight) {}

void GateHuberLoss::Evaluate(double squared_norm, double rho[3]) const {
  if (squared_norm <= squared_threshold_) {
    rho[0] = squared_norm, rho[1] = 1, rho[2] = 0;
    return;
  }
  const double root = std::sqrt(squared_norm * squared_threshold_);
  rho[0] = 2 * root - squared_threshold_;
  rho[1] = squared_threshold_ / root;
  // 0 in place of the kernel's second derivative: iteratively reweighted least squares, which does
  // not take the curvature away from observations over the threshold.
  rho[2] = 0;
}

bool LeftRotationManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const Eigen::Map<const Eigen::Quaterniond> rotation(x);
  const Eigen::Map<const Eigen::Vector3d> omega(delta);
  const Eigen::Quaterniond sum = (ExpSo3(omega) * rotation).normalized();
  Eigen::Map<Eigen::Vector4d>{x_plus_delta} = sum.coeffs();
  return true;
}

bool LeftRotationManifold::PlusJacobian(const double*, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 4, 3, Eigen::RowMajor>>(jacobian).setIdentity();
  return true;
}

bool LeftRotationManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  const Eigen::Map<const Eigen::Quaterniond> to(y), from(x);
  Eigen::Map<Eigen::Vector3d>(y_minus_x, 3) = LogSo3(to * from.conjugate());
  return true;
}

bool LeftRotationManifold::MinusJacobian(const double*, double*) const { return false; }

}  // namespace ofm
