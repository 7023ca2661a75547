#include "ofm/geometry/rigid_transform.h"

#include <cmath>

namespace ofm {
namespace {

constexpr double kSmallAngle = 1e-6;

/// Left Jacobian of SO(3): translation = V(omega) rho (Barfoot, State Estimation for
/// Robotics, 7.85).
Eigen::Matrix3d LeftJacobian(const Eigen::Vector3d& omega) {
  const double angle = omega.norm();
  const Eigen::Matrix3d skew = SkewSymmetric(omega);
  if (angle < kSmallAngle) return Eigen::Matrix3d::Identity() + 0.5 * skew;
  const double squared = angle * angle;
  return Eigen::Matrix3d::Identity() + (1 - std::cos(angle)) / squared * skew +
         (angle - std::sin(angle)) / (squared * angle) * skew * skew;
}

}  // namespace

Eigen::Matrix3d SkewSymmetric(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Quaterniond ExpSo3(const Eigen::Vector3d& omega) {
  const double angle = omega.norm();
  const double half = 0.5 * angle;
  // sin(x/2)/x, by its series near zero.
  const double scale = angle < kSmallAngle ? 0.5 - angle * angle / 48 : std::sin(half) / angle;
  const Eigen::Vector3d imaginary = scale * omega;
  return Eigen::Quaterniond(std::cos(half), imaginary.x(), imaginary.y(), imaginary.z());
}

Eigen::Vector3d LogSo3(const Eigen::Quaterniond& rotation) {
  const double sign = rotation.w() < 0 ? -1 : 1;
  const Eigen::Vector3d imaginary = sign * rotation.vec();
  const double sine = imaginary.norm();
  if (sine < kSmallAngle) return 2 * imaginary / (sign * rotation.w());
  return 2 * std::atan2(sine, sign * rotation.w()) / sine * imaginary;
}

RigidTransform ExpSe3(const Vector6d& twist) {
  const Eigen::Vector3d omega = twist.tail<3>();
  return {ExpSo3(omega), LeftJacobian(omega) * twist.head<3>()};
}

Vector6d LogSe3(const RigidTransform& transform) {
  const Eigen::Vector3d omega = LogSo3(transform.rotation());
  Vector6d twist;
  twist << LeftJacobian(omega).partialPivLu().solve(transform.translation()), omega;
  return twist;
}

RigidTransform Interpolate(const RigidTransform& a, const RigidTransform& b, double ratio) {
  return {a.rotation().slerp(ratio, b.rotation()),
          (1 - ratio) * a.translation() + ratio * b.translation()};
}

}  // namespace ofm
