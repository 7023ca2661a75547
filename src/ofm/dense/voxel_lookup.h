// Finds points by the voxel they are in.
#pragma once

#include <optional>

#include "ofm/dense/voxel_table.h"

namespace ofm {

/// Numbers points 0, 1, 2, ... as they are added, and finds the first that was added in a voxel.
class VoxelLookup {
 public:
  explicit VoxelLookup(double resolution_m) : voxels_per_metre_(1 / resolution_m) {}

  /// Points that are not finite or beyond the grid's limits get a number, but are never found.
  void Add(const Eigen::Vector3f& position) {
    const auto voxel = VoxelOf(position);
    if (voxel && voxels_.Insert(*voxel) == first_.size()) first_.push_back(points_);
    ++points_;
  }

  std::optional<VoxelIndex> VoxelOf(const Eigen::Vector3f& position) const {
    return FindVoxel(position, voxels_per_metre_);
  }
  std::optional<std::size_t> Find(const VoxelIndex& voxel) const {
    const auto number = voxels_.Find(voxel);
    return number ? std::optional(first_[*number]) : std::nullopt;
  }
  std::optional<std::size_t> Find(const Eigen::Vector3f& position) const {
    const auto voxel = VoxelOf(position);
    return voxel ? Find(*voxel) : std::nullopt;
  }

 private:
  double voxels_per_metre_;
  VoxelTable voxels_;
  std::vector<std::size_t> first_;  // by the voxel's number
  std::size_t points_ = 0;
};

}  // namespace ofm
