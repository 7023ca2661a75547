// A landmark seen in a keyframe, as the estimators take it.
#pragma once

#include <Eigen/Core>

namespace ofm {

/// Where a point was seen. The residual is three-fold and in standard deviations:
///   (u_measured - u_predicted) / pixel_sigma, the same for v, and, where depth was measured,
///   (1 / depth_measured - 1 / z_predicted) / inverse_depth_sigma.
/// Inverse depth is used because a structured-light camera's noise is constant in it (see
/// DepthSigma: sigma_z = k z^2 means sigma_(1/z) = k).
struct PointObservation {
  Eigen::Vector2d ideal_px = Eigen::Vector2d::Zero();  ///< undistorted [px]
  double depth_m = 0;                                  ///< 0 = not measured
  double pixel_sigma = 1;                              ///< [px]
  double inverse_depth_sigma = 1;                      ///< [1/m]; unused without depth
  double weight = 1;  ///< static probability; multiplies information
};

/// 95 % quantiles of chi-square for two and three degrees of freedom: the inlier gates.
inline constexpr double kChi2Gate2 = 5.991;
inline constexpr double kChi2Gate3 = 7.815;

}  // namespace ofm
