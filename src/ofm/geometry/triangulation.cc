#include "ofm/geometry/triangulation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "ofm/base/check.h"

namespace ofm {
namespace {

/// Angle between the lines, in [0, pi / 2]: rays that run against one another fix no point either.
double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

double MaxParallax(std::span<const Ray> rays) {
  double parallax_rad = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    for (std::size_t j = i + 1; j < rays.size(); ++j) {
      parallax_rad = std::max(parallax_rad, AngleBetween(rays[i].direction, rays[j].direction));
    }
  }
  return parallax_rad;
}

}  // namespace

Ray Ray::FromCamera(const RigidTransform& camera_from_world, const Eigen::Vector2d& normalized_px) {
  const RigidTransform world_from_camera = camera_from_world.Inverse();
  return {world_from_camera.translation(),
          world_from_camera.rotation() * normalized_px.homogeneous().normalized()};
}

std::optional<TriangulatedPoint> TriangulateRays(std::span<const Ray> rays,
                                                 double min_parallax_rad) {
  OFM_CHECK(rays.size() >= 2 && min_parallax_rad > 0);
  TriangulatedPoint result;
  result.parallax_rad = MaxParallax(rays);
  if (!(result.parallax_rad >= min_parallax_rad)) return {};

  // Origins relative to the first: far from the world's origin no digits are lost.
  const Eigen::Vector3d base = rays[0].origin;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_side = Eigen::Vector3d::Zero();
  for (const Ray& ray : rays) {
    const Eigen::Vector3d along = ray.direction.normalized();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along * along.transpose();
    normal += across;
    right_side += across * (ray.origin - base);
  }
  result.point_in_world = base + normal.ldlt().solve(right_side);
  if (!result.point_in_world.allFinite()) return {};
  for (const Ray& ray : rays) {
    const Eigen::Vector3d along = ray.direction.normalized();
    const Eigen::Vector3d offset = result.point_in_world - ray.origin;
    if (!(offset.dot(along) > 0)) return {};
    result.max_distance_m = std::max(result.max_distance_m, offset.cross(along).norm());
  }
  return result;
}

}  // namespace ofm
