// The residual that all estimators share: a map point against where a frame saw it.
#pragma once

#include <Eigen/Core>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/estimation/observation.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// Points nearer than this to the camera's plane, or behind it, have no residual [m].
inline constexpr double kMinPointDepth_m = 0.01;

inline bool IsBeforeCamera(const Eigen::Vector3d& point_in_camera) {
  return point_in_camera.z() > kMinPointDepth_m;
}

inline bool HasDepth(const PointObservation& seen) { return seen.depth_m > 0; }

/// The squared residual over which an observation is an outlier.
inline double ChiSquareGate(const PointObservation& seen) {
  return HasDepth(seen) ? kChi2Gate3 : kChi2Gate2;
}

/// True where every number is finite, the sigmas are positive, depth and weight not negative.
bool IsValid(const PointObservation& seen);

/// (u, v, inverse depth), measured less predicted, in standard deviations as PointObservation
/// says; the third is 0 without depth. The weight is not applied. The point must be before the
/// camera.
Eigen::Vector3d ReprojectionResidual(const PinholeCamera& camera,
                                     const Eigen::Vector3d& point_in_camera,
                                     const PointObservation& seen);

/// Derivative of ReprojectionResidual by point_in_camera.
Eigen::Matrix3d ReprojectionJacobian(const PinholeCamera& camera,
                                     const Eigen::Vector3d& point_in_camera,
                                     const PointObservation& seen);

/// Derivative of Exp(xi) * point_in_camera by xi = (rho, omega) at 0: [I, -skew(p)] (Barfoot,
/// State Estimation for Robotics, 7.185).
Eigen::Matrix<double, 3, 6> LeftPerturbationJacobian(const Eigen::Vector3d& point_in_camera);

/// Squared norm of the residual; infinite for a point that is not before the camera.
double ReprojectionChiSquare(const PinholeCamera& camera, const Eigen::Vector3d& point_in_camera,
                             const PointObservation& seen);

}  // namespace ofm
