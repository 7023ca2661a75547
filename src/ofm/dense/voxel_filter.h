// Voxel-grid down-sampling of labelled clouds.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ofm/dense/label_belief.h"
#include "ofm/dense/label_votes.h"
#include "ofm/dense/labelled_point.h"
#include "ofm/dense/voxel_table.h"

namespace ofm {

/// A point's confidence as it stands.
struct PointConfidence {
  explicit PointConfidence(double /*resolution_m*/) {}
  std::uint8_t operator()(const LabelledPoint& point) const { return point.confidence; }
};

/// The instance of a voxel: one that most of its points are of is always found (Boyer and Moore,
/// "MJRTY: a fast majority vote algorithm", 1981).
class InstanceVotes {
 public:
  void Add(std::uint16_t instance);
  std::uint16_t Best() const { return instance_; }

 private:
  std::uint16_t instance_ = kNoInstance;
  int lead_ = 0;
};

/// What the points of a voxel came to.
struct FusedVoxel {
  LabelledPoint point;                                  ///< as Points() has it
  double precision = 0;                                 ///< sum over the points [1/m^2]
  Eigen::Vector3f viewpoint = Eigen::Vector3f::Zero();  ///< mean, weighted alike [m]
};

/// Gathers points in voxels and gives one point per voxel: the mean of their positions weighted by
/// their precision, mean colour and precision, one label, and where it has one the instance of most
/// points.
template <class Labels, class Weight>
class BasicVoxelFilter {
 public:
  explicit BasicVoxelFilter(double resolution_m)
      : voxels_per_metre_(1 / resolution_m), weight_(resolution_m) {}

  /// Points that are not finite or beyond the grid's limits are left out, and nothing is given.
  /// Else the number of the point's voxel, from 0 in the order in which they were first met.
  /// `viewpoint` is where the point was seen from.
  std::optional<std::uint32_t> Add(const LabelledPoint& point,
                                   const Eigen::Vector3f& viewpoint = Eigen::Vector3f::Zero());

  /// One point per voxel, in the order in which the voxels were first met.
  std::vector<LabelledPoint> Points() const;
  /// The same with more of what is known.
  std::vector<FusedVoxel> Voxels() const;

 private:
  struct Sum {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
    Eigen::Vector3i color = Eigen::Vector3i::Zero();
    double precision = 0;
    int count = 0;
    Labels labels;
    InstanceVotes instances;

    LabelledPoint Point() const;
  };

  std::uint32_t NumberOf(const VoxelIndex& voxel);

  double voxels_per_metre_;
  Weight weight_;
  VoxelTable table_;
  std::vector<Sum> sums_;
  VoxelIndex last_voxel_ = VoxelIndex::Constant(kVoxelLimit);  // none has that index
  std::uint32_t last_number_ = 0;
};

/// For points of one view, which are not independent: the label with most confidence, and its mean
/// confidence.
using VoxelFilter = BasicVoxelFilter<LabelVotes, PointConfidence>;

/// For points of many views: labels by Bayes' rule.
using ViewVoxelFilter = BasicVoxelFilter<LabelBelief, PointEvidence>;

extern template class BasicVoxelFilter<LabelVotes, PointConfidence>;
extern template class BasicVoxelFilter<LabelBelief, PointEvidence>;

}  // namespace ofm
