// The octree kept up with the map while a run goes on.
#pragma once

#include "ofm/dense/octree_integrator.h"
#include "ofm/dense/settled_poses.h"

namespace ofm {

/// Brings an octree up to clouds and poses.
class OctreeUpkeep {
 public:
  explicit OctreeUpkeep(const DenseOptions& options);

  /// New key frames are added, and those that moved by more than half a voxel are integrated again,
  /// when their poses have settled. As that goes through everything around them, it waits until as
  /// many were added as the last time cost: all in all the upkeep costs about twice what adding
  /// does.
  void Update(const KeyframeClouds& clouds, const KeyframePoseMap& world_from_camera);

  /// The octree of exactly these poses: what SemanticMapper::Build has, also after an Update that
  /// threw. Nothing may follow.
  SemanticOctree Finish(const KeyframeClouds& clouds, const KeyframePoseMap& world_from_camera);

 private:
  double Tolerance_m() const { return options_.resolution_m / 2; }

  DenseOptions options_;
  SettledPoses settled_;
  OctreeIntegrator integrator_;
  std::ptrdiff_t credit_ = 0;  // key frames added over those integrated again
  bool is_whole_ = true;       // false where an update was cut short by an error
};

}  // namespace ofm
