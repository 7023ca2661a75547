// The voxels that a ray crosses.
#pragma once

#include <limits>

#include "ofm/dense/voxel_table.h"

namespace ofm {

/// Calls visit(VoxelIndex) for each voxel from that of `origin` up to, and without, that of `end`
/// (Amanatides and Woo, "A fast voxel traversal algorithm for ray tracing", Eurographics 1987). The
/// types of the numbers are OctoMap's, so that both cross the same voxels. Both points must be
/// inside the grid's limits.
template <class Visit>
void TraverseRay(const Eigen::Vector3f& origin, const Eigen::Vector3f& end, double resolution_m,
                 Visit&& visit) {
  VoxelIndex voxel = *FindVoxel(origin, 1 / resolution_m);
  const VoxelIndex last = *FindVoxel(end, 1 / resolution_m);
  if (voxel == last) return;
  Eigen::Vector3f direction = end - origin;
  const float length = direction.norm();
  direction /= length;
  VoxelIndex step;
  Eigen::Vector3d border_distance, voxel_distance;  // along the ray: to the next border, per voxel
  for (int axis = 0; axis < 3; ++axis) {
    step[axis] = (direction[axis] > 0) - (direction[axis] < 0);
    border_distance[axis] = voxel_distance[axis] = std::numeric_limits<double>::max();
    if (step[axis] == 0) continue;
    const double center = (voxel[axis] + .5) * resolution_m;
    const double border = center + static_cast<float>(step[axis] * resolution_m * .5);
    border_distance[axis] = (border - origin[axis]) / direction[axis];
    voxel_distance[axis] = resolution_m / std::abs(static_cast<double>(direction[axis]));
  }
  const auto nearest = [&border_distance] {
    const Eigen::Vector3d& d = border_distance;
    return d[0] < d[1] ? (d[0] < d[2] ? 0 : 2) : (d[1] < d[2] ? 1 : 2);
  };
  int axis = nearest();
  do {
    visit(voxel);
    voxel[axis] += step[axis];
    border_distance[axis] += voxel_distance[axis];
    axis = nearest();
  } while (voxel != last && border_distance[axis] <= length);
}

}  // namespace ofm
