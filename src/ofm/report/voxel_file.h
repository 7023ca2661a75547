// The occupied voxels of an octree file, with the labels beside it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "ofm/dense/labelled_point.h"

namespace ofm {

/// An occupied leaf.
struct LabelledVoxel {
  Eigen::Vector3f center = Eigen::Vector3f::Zero();  ///< in the file's world [m]
  std::uint8_t size_exponent = 0;                    ///< its side is resolution_m * 2^size_exponent
  Rgb color;
  std::uint8_t class_id = kNoLabel;
};

struct VoxelSet {
  double resolution_m = 0;
  std::vector<LabelledVoxel> voxels;
};

/// Reads map.ot and, where it exists, map_labels.csv. Where there are more than `max_voxels`
/// leaves, levels of the tree are left out until there are not; a voxel that stands for several has
/// their mean colour and the first of their labels. Throws Error with file, and line of the labels.
VoxelSet LoadVoxels(const std::filesystem::path& octree, const std::filesystem::path& labels,
                    std::size_t max_voxels);

}  // namespace ofm
