#include "ofm/geometry/rigid_transform.h"

#include <cmath>

namespace ofm {
namespace {

// Under it the first term of each series below is exact to a double's last digit.
constexpr double kSmallAngle = 1e-8;

/// sin(x / 2) / x, for x >= 0.
double HalfSinc(double x) { return x < kSmallAngle ? 0.5 : std::sin(0.5 * x) / x; }

/// (x - sin x) / x^3, for x >= 0.
double CubicRemainder(double x) {
  constexpr double kSeriesLimit = 0.1;  // where the difference loses as much as the series
  const double squared = x * x;
  if (x > kSeriesLimit) return (x - std::sin(x)) / (squared * x);
  return 1.0 / 6 - squared * (1.0 / 120 - squared * (1.0 / 5040 - squared / 362880));
}

/// Left Jacobian of SO(3): translation = V(omega) rho (Barfoot, State Estimation for
/// Robotics, 7.85).
Eigen::Matrix3d LeftJacobian(const Eigen::Vector3d& omega) {
  const double angle = omega.norm();
  const Eigen::Matrix3d skew = SkewSymmetric(omega);
  const double half_sinc = HalfSinc(angle);  // 1 - cos x = 2 sin^2(x / 2), without the cancellation
  return Eigen::Matrix3d::Identity() + 2 * half_sinc * half_sinc * skew +
         CubicRemainder(angle) * skew * skew;
}

}  // namespace

Eigen::Matrix3d SkewSymmetric(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Quaterniond ExpSo3(const Eigen::Vector3d& omega) {
  const double angle = omega.norm();
  const Eigen::Vector3d imaginary = HalfSinc(angle) * omega;
  return Eigen::Quaterniond(std::cos(0.5 * angle), imaginary.x(), imaginary.y(), imaginary.z());
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
