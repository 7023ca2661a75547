// An object in the making: observations that are believed to be of one thing.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <vector>

#include "ofm/base/ids.h"
#include "ofm/dense/voxel_table.h"
#include "ofm/objects/object_observation.h"

namespace ofm {

/// An observation where its key frame's pose puts it.
struct PlacedObservation {
  KeyframeId keyframe;
  std::int64_t stamp_ns = 0;
  ClassId class_id;
  float score = 0;
  Rgb color;
  std::vector<Eigen::Vector3f> points_in_world;
  std::size_t instance = 0;  ///< its place among the key frame's instances
};

/// Where a hypothesis is.
struct Spread {
  Eigen::Vector3d center = {0, 0, 0};  ///< [m]
  double radius_m = 0;                 ///< root mean square distance from it
};

/// Voxels with the number of observations that fill each, and what their classes say. A value.
class ObjectHypothesis {
 public:
  explicit ObjectHypothesis(double voxel_m) : voxel_m_(voxel_m) {}

  void Add(PlacedObservation observation);
  /// Takes over all observations of `other`.
  void Absorb(const ObjectHypothesis& other);

  /// Share of this one's voxels that `other` fills too, or a voxel beside: what the noise of depth
  /// and poses costs. Voxels that few observations fill do not count, as one wrong mask would make
  /// neighbours one.
  double ShareIn(const ObjectHypothesis& other) const;
  /// False where no voxel can be shared: a quick test.
  bool IsNear(const ObjectHypothesis& other) const;
  /// Number of voxels that count.
  int Size() const;
  /// Centres of these voxels [m], by increasing x, y, z.
  std::vector<Eigen::Vector3f> Centers() const;
  /// Of these centres.
  Spread FindSpread() const;
  /// Points of all observations in voxels that count.
  std::vector<Eigen::Vector3f> Points() const;

  /// The class with the largest sum of scores; of equals the smaller id.
  ClassId BestClass() const;
  /// Sums of scores by class, and of all.
  const std::map<ClassId, double>& class_weights() const { return class_weights_; }
  double Weight() const;
  /// True where a class has at least a quarter of the weight.
  bool IsLikely(ClassId class_id) const;

  /// By the order of Add.
  const std::vector<PlacedObservation>& observations() const { return observations_; }
  /// Best score by the key frames that saw it.
  const std::map<KeyframeId, float>& views() const { return views_; }
  bool SawIn(KeyframeId keyframe, ClassId class_id) const;

 private:
  bool Counts(std::uint32_t voxel) const { return counts_[voxel] >= MinCount(); }
  int MinCount() const;
  bool FillsNear(const VoxelIndex& voxel) const;

  double voxel_m_;
  VoxelTable voxels_;
  std::vector<int> counts_;  // observations, by voxel
  Eigen::AlignedBox3i bounds_;
  std::vector<PlacedObservation> observations_;
  std::map<KeyframeId, float> views_;
  std::map<ClassId, double> class_weights_;
};

}  // namespace ofm
