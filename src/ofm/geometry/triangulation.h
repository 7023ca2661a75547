// Points in space from the rays along which several cameras see them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// A line of sight: from a camera's centre towards what it sees.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();      ///< [m], in the world
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< of any length but 0, in the world

  /// The ray on which a camera sees the point (x, y, 1) of its normalised image.
  static Ray FromCamera(const RigidTransform& camera_from_world,
                        const Eigen::Vector2d& normalized_px);
};

struct TriangulatedPoint {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  double parallax_rad = 0;    ///< the largest angle between two rays' lines, in [0, pi / 2]
  double max_distance_m = 0;  ///< of the point from a ray
};

/// The point with the least sum of squared distances from two or more rays (of two: the middle of
/// the shortest line between them; Hartley and Sturm, Triangulation, 1997, section 5.3; of more:
/// its linear least squares). Empty where the rays are closer to parallel than `min_parallax_rad`
/// or the point is not in front of every origin.
std::optional<TriangulatedPoint> TriangulateRays(std::span<const Ray> rays,
                                                 double min_parallax_rad);

}  // namespace ofm
