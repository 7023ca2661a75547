// Where is the floor?
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <span>

#include "ofm/base/ids.h"
#include "ofm/dense/dense_options.h"
#include "ofm/dense/semantic_octree.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// The points p with normal · p + offset_m = 0; on the normal's side heights are positive.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of length 1
  double offset_m = 0;

  double Height_m(const Eigen::Vector3d& point) const { return normal.dot(point) + offset_m; }
};

/// What the cameras think is up, on average, a unit vector: against the images' y axis. Poses that
/// are not finite are left out; against the world's y axis where nothing is known.
Eigen::Vector3d MeanUp(const std::map<KeyframeId, RigidTransform>& world_from_camera);

/// The dominant plane among `surface_in_world` (centres of occupied voxels of side `resolution_m`)
/// that can be a floor: nearly at right angles to `up_in_world` (of length 1; what the cameras
/// think is up, roughly), with little of the surface beneath it and enough in it. RANSAC, then
/// least squares. Empty where there is none. The same input gives the same plane.
std::optional<Plane> FindFloor(std::span<const Eigen::Vector3f> surface_in_world,
                               const Eigen::Vector3d& up_in_world, double resolution_m,
                               const FloorOptions& options);
/// The same among the octree's occupied voxels.
std::optional<Plane> FindFloor(const SemanticOctree& octree, const Eigen::Vector3d& up_in_world,
                               const FloorOptions& options);

}  // namespace ofm
