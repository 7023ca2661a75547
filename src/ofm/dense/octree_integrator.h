// The octree of key frames whose poses change.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "ofm/dense/dense_options.h"
#include "ofm/dense/keyframe_cloud.h"
#include "ofm/dense/semantic_octree.h"

namespace ofm {

/// False where a pose is not finite, or so far away that the octree has no voxels there.
bool IsUsablePose(const RigidTransform& world_from_camera, const DenseOptions& options);

/// How far the change of a key frame's pose can move a point of its cloud halfway to the range
/// limit, where most are at most [m]; exactly 0 where the poses are equal.
double MapShift_m(const RigidTransform& before, const RigidTransform& after,
                  const DenseOptions& options);

/// What an update did, in key frames.
struct IntegrationCounts {
  std::size_t added = 0;         ///< that were new
  std::size_t moved = 0;         ///< whose pose or cloud had changed
  std::size_t removed = 0;       ///< that have no usable pose any more
  std::size_t reintegrated = 0;  ///< of those that stay, gone through again for the others' sake
};

/// Holds an octree and the poses with which each key frame went into it. It always is what the
/// clouds at these poses give when they are inserted in the order of their ids: as log-odds are
/// clamped, nothing can be taken out again, and so the blocks of voxels that a key frame touched
/// before or touches now are forgotten and rebuilt from all key frames that touch them.
/// Not thread-safe.
class OctreeIntegrator {
 public:
  explicit OctreeIntegrator(const DenseOptions& options);

  /// Takes in key frames that are new and have a usable pose, takes out those that lost theirs, and
  /// integrates again those whose pose moved the map by more than `tolerance_m`. With 0 the octree
  /// becomes the one of exactly these poses.
  IntegrationCounts Update(const KeyframeClouds& clouds, const KeyframePoseMap& world_from_camera,
                           double tolerance_m);

  const SemanticOctree& octree() const { return octree_; }
  /// Gives the octree away, and begins anew.
  SemanticOctree Take();
  /// Of the octree and what is remembered of key frames, without their clouds.
  std::size_t MemoryBytes() const;

 private:
  struct Integrated {
    std::shared_ptr<const KeyframeCloud> cloud;
    RigidTransform world_from_camera;
    std::vector<std::uint32_t> blocks;  // that it touches
  };
  struct Changes {
    std::map<KeyframeId, Integrated> added, moved;  // without their blocks
    std::vector<KeyframeId> removed;
  };

  Changes FindChanges(const KeyframeClouds& clouds, const KeyframePoseMap& world_from_camera,
                      double tolerance_m) const;
  void Insert(Integrated& keyframe);
  void InsertAllAnew();
  std::vector<std::uint32_t> Apply(const Changes& changes);
  std::size_t Rebuild(const std::vector<std::uint32_t>& blocks);

  DenseOptions options_;
  SemanticOctree octree_;
  std::map<KeyframeId, Integrated> integrated_;
};

}  // namespace ofm
