// Voxels of a regular grid, and a hash table that numbers them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

namespace ofm {

/// Coordinates of a voxel: floor(position / resolution) in each axis. Those of OctoMap's keys less
/// kVoxelLimit.
using VoxelIndex = Eigen::Vector3i;

/// Voxels have coordinates in [-kVoxelLimit, kVoxelLimit), as in an OctoMap of 16 levels.
inline constexpr int kVoxelLimit = 32768;

/// The voxel that `position` [m] is in; empty where it is not finite or beyond the grid's limits.
inline std::optional<VoxelIndex> FindVoxel(const Eigen::Vector3f& position,
                                           double voxels_per_metre) {
  VoxelIndex voxel;
  for (int axis = 0; axis < 3; ++axis) {
    const double coordinate = voxels_per_metre * position[axis];
    if (!(coordinate >= -kVoxelLimit && coordinate < kVoxelLimit)) return {};
    const int towards_zero = static_cast<int>(coordinate);  // std::floor is a call, this is hot
    voxel[axis] = towards_zero - (coordinate < towards_zero ? 1 : 0);
  }
  return voxel;
}

/// Centre of a voxel [m].
inline Eigen::Vector3f VoxelCenter(const VoxelIndex& voxel, double resolution_m) {
  return ((voxel.cast<double>().array() + .5) * resolution_m).cast<float>();
}

/// Numbers voxels 0, 1, 2, ... in the order in which they are first named.
class VoxelTable {
 public:
  VoxelTable();

  /// The number of `voxel`; size() if it is new.
  std::uint32_t Insert(const VoxelIndex& voxel);
  /// Empty where `voxel` was never inserted.
  std::optional<std::uint32_t> Find(const VoxelIndex& voxel) const;

  std::size_t size() const { return keys_.size(); }
  /// The voxel of that number.
  VoxelIndex At(std::uint32_t number) const;
  /// All numbers, by increasing x, then y, then z of their voxels.
  std::vector<std::uint32_t> SortedNumbers() const;
  std::size_t MemoryBytes() const;

 private:
  std::size_t FindSlot(std::uint64_t key) const;
  void Grow();

  std::vector<std::uint32_t> slots_;  // number + 1, 0 = empty; open addressing, linear probing
  std::vector<std::uint64_t> keys_;   // by number
  int shift_;
};

}  // namespace ofm
