#include "ofm/estimation/pose_graph_cost.h"

#include <cmath>

#include "ofm/base/check.h"

namespace ofm {
namespace {

using RowMajor64 = Eigen::Matrix<double, 6, 4, Eigen::RowMajor>;
using RowMajor63 = Eigen::Matrix<double, 6, 3, Eigen::RowMajor>;

/// Derivative of LogSo3(Exp(xi) * R) by xi at 0, where `omega` is LogSo3(R) (Barfoot, State
/// Estimation for Robotics, 7.76).
Eigen::Matrix3d InverseLeftJacobian(const Eigen::Vector3d& omega) {
  constexpr double kSeriesLimit = 1e-2;  // where the closed form loses as much as the series
  const double squared = omega.squaredNorm();
  const double angle = std::sqrt(squared);
  const double factor = angle < kSeriesLimit
                            ? 1.0 / 12 + squared / 720
                            : 1 / squared - 1 / (2 * angle * std::tan(0.5 * angle));
  const Eigen::Matrix3d skew = SkewSymmetric(omega);
  return Eigen::Matrix3d::Identity() - 0.5 * skew + factor * skew * skew;
}

}  // namespace

RelativePoseCost::RelativePoseCost(const RigidTransform& target_from_source,
                                   const RelativePoseSigma& sigma)
    : measured_(target_from_source),
      translation_scale_(1 / sigma.translation_m),
      rotation_scale_(1 / sigma.rotation_rad) {
  OFM_CHECK(sigma.translation_m > 0 && sigma.rotation_rad > 0);
}

bool RelativePoseCost::Evaluate(double const* const* parameters, double* residuals,
                                double** jacobians) const {
  const Eigen::Map<const Eigen::Quaterniond> source(parameters[0]), target(parameters[2]);
  const Eigen::Map<const Eigen::Vector3d> source_translation(parameters[1]);
  const Eigen::Map<const Eigen::Vector3d> target_translation(parameters[3]);
  const Eigen::Quaterniond rotation = target * source.conjugate();
  const Eigen::Vector3d lever = rotation * source_translation;
  const Eigen::Vector3d omega = LogSo3(rotation * measured_.rotation().conjugate());
  Eigen::Map<Eigen::Matrix<double, 6, 1>> residual(residuals);
  residual.head<3>() = translation_scale_ * (target_translation - lever - measured_.translation());
  residual.tail<3>() = rotation_scale_ * omega;
  if (jacobians == nullptr) return true;

  // A turn of the source by omega is one of the target by -(rotation * omega), but for the target's
  // translation, which stays.
  const Eigen::Matrix3d turn = rotation.toRotationMatrix();
  Eigen::Matrix<double, 6, 3> by_target;
  by_target << translation_scale_ * SkewSymmetric(lever),
      rotation_scale_ * InverseLeftJacobian(omega);
  if (jacobians[0] != nullptr) {
    Eigen::Map<RowMajor64>{jacobians[0]} << -by_target * turn, Eigen::Matrix<double, 6, 1>::Zero();
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<RowMajor63>{jacobians[1]} << -translation_scale_ * turn, Eigen::Matrix3d::Zero();
  }
  if (jacobians[2] != nullptr) {
    Eigen::Map<RowMajor64>{jacobians[2]} << by_target, Eigen::Matrix<double, 6, 1>::Zero();
  }
  if (jacobians[3] != nullptr) {
    Eigen::Map<RowMajor63>{jacobians[3]} << translation_scale_ * Eigen::Matrix3d::Identity(),
        Eigen::Matrix3d::Zero();
  }
  return true;
}

}  // namespace ofm
