// Rigid transforms, written target_from_source: p_target = target_from_source * p_source.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ofm {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// A rotation followed by a translation in metres (an element of SE(3)).
class RigidTransform {
 public:
  RigidTransform() = default;
  /// `rotation` is normalised.
  RigidTransform(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation)
      : rotation_(rotation.normalized()), translation_(translation) {}
  RigidTransform(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation)
      : RigidTransform(Eigen::Quaterniond(rotation), translation) {}

  /// The transform with just these numbers, which another one's accessors gave: normalising again
  /// could change the last bit.
  static RigidTransform FromParts(const Eigen::Quaterniond& rotation,
                                  const Eigen::Vector3d& translation) {
    RigidTransform transform;
    transform.rotation_ = rotation;
    transform.translation_ = translation;
    return transform;
  }

  const Eigen::Quaterniond& rotation() const { return rotation_; }
  const Eigen::Vector3d& translation() const { return translation_; }
  Eigen::Matrix3d RotationMatrix() const { return rotation_.toRotationMatrix(); }

  RigidTransform Inverse() const {
    const Eigen::Quaterniond inverse = rotation_.conjugate();
    return {inverse, -(inverse * translation_)};
  }
  RigidTransform operator*(const RigidTransform& other) const {
    return {rotation_ * other.rotation_, rotation_ * other.translation_ + translation_};
  }
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return rotation_ * point + translation_;
  }

  /// Angle of the rotation [rad], in [0, pi].
  double RotationAngle() const { return Eigen::AngleAxisd(rotation_).angle(); }
  /// True where no element is NaN or infinite.
  bool IsFinite() const { return rotation_.coeffs().allFinite() && translation_.allFinite(); }

 private:
  Eigen::Quaterniond rotation_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation_ = Eigen::Vector3d::Zero();
};

Eigen::Matrix3d SkewSymmetric(const Eigen::Vector3d& v);

/// Rotation by the axis-angle vector `omega` [rad]; accurate near zero.
Eigen::Quaterniond ExpSo3(const Eigen::Vector3d& omega);
/// Inverse of ExpSo3, |omega| <= pi.
Eigen::Vector3d LogSo3(const Eigen::Quaterniond& rotation);

/// Exponential of the twist (translation part rho [m], rotation part omega [rad]) on SE(3).
RigidTransform ExpSe3(const Vector6d& twist);
/// Inverse of ExpSe3.
Vector6d LogSe3(const RigidTransform& transform);

/// The transform `ratio` (0 to 1) of the way from `a` to `b`: linear in translation, slerp in
/// rotation.
RigidTransform Interpolate(const RigidTransform& a, const RigidTransform& b, double ratio);

}  // namespace ofm
