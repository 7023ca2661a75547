#include "ofm/estimation/reprojection.h"

#include <cmath>
#include <limits>

namespace ofm {

bool IsValid(const PointObservation& seen) {
  const double sum = seen.ideal_px.x() + seen.ideal_px.y() + seen.depth_m + seen.pixel_sigma +
                     seen.inverse_depth_sigma + seen.weight;
  return std::isfinite(sum) && seen.depth_m >= 0 && seen.pixel_sigma > 0 &&
         seen.inverse_depth_sigma > 0 && seen.weight >= 0;
}

Eigen::Vector3d ReprojectionResidual(const PinholeCamera& camera,
                                     const Eigen::Vector3d& point_in_camera,
                                     const PointObservation& seen) {
  Eigen::Vector3d residual;
  residual.head<2>() = (seen.ideal_px - camera.ProjectIdeal(point_in_camera)) / seen.pixel_sigma;
  residual.z() =
      HasDepth(seen) ? (1 / seen.depth_m - 1 / point_in_camera.z()) / seen.inverse_depth_sigma : 0;
  return residual;
}

Eigen::Matrix3d ReprojectionJacobian(const PinholeCamera& camera,
                                     const Eigen::Vector3d& point_in_camera,
                                     const PointObservation& seen) {
  const double inverse_z = 1 / point_in_camera.z();
  const double u_scale = camera.fx / seen.pixel_sigma * inverse_z;
  const double v_scale = camera.fy / seen.pixel_sigma * inverse_z;
  const double d_scale = HasDepth(seen) ? inverse_z * inverse_z / seen.inverse_depth_sigma : 0;
  Eigen::Matrix3d jacobian;
  jacobian << -u_scale, 0, u_scale * point_in_camera.x() * inverse_z,  //
      0, -v_scale, v_scale * point_in_camera.y() * inverse_z,          //
      0, 0, d_scale;
  return jacobian;
}

Eigen::Matrix<double, 3, 6> LeftPerturbationJacobian(const Eigen::Vector3d& point_in_camera) {
  Eigen::Matrix<double, 3, 6> jacobian;
  jacobian << Eigen::Matrix3d::Identity(), -SkewSymmetric(point_in_camera);
  return jacobian;
}

double ReprojectionChiSquare(const PinholeCamera& camera, const Eigen::Vector3d& point_in_camera,
                             const PointObservation& seen) {
  if (!IsBeforeCamera(point_in_camera)) return std::numeric_limits<double>::infinity();
  return ReprojectionResidual(camera, point_in_camera, seen).squaredNorm();
}

}  // namespace ofm
