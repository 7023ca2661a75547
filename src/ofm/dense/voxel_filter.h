// Voxel-grid down-sampling of labelled clouds.
#pragma once

#include <vector>

#include "ofm/dense/label_votes.h"
#include "ofm/dense/labelled_point.h"
#include "ofm/dense/voxel_table.h"

namespace ofm {

/// Gathers points in voxels and gives one point per voxel: mean position, mean colour, and the
/// label with most confidence.
class VoxelFilter {
 public:
  explicit VoxelFilter(double resolution_m) : voxels_per_metre_(1 / resolution_m) {}

  /// Points that are not finite or beyond the grid's limits are left out.
  void Add(const LabelledPoint& point);

  /// One point per voxel, in the order in which the voxels were first met.
  std::vector<LabelledPoint> Points() const;

 private:
  struct Sum {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3i color = Eigen::Vector3i::Zero();
    int count = 0;
    LabelVotes votes;
  };

  double voxels_per_metre_;
  VoxelTable table_;
  std::vector<Sum> sums_;
};

}  // namespace ofm
