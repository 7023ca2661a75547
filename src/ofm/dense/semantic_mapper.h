// From labelled key frames and their poses to the semantic map.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "ofm/base/ids.h"
#include "ofm/dense/dense_options.h"
#include "ofm/dense/keyframe_cloud.h"
#include "ofm/dense/navigation_grid.h"
#include "ofm/dense/semantic_octree.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

struct SemanticMap {
  std::vector<LabelledPoint> cloud_in_world;  ///< one point per cloud voxel
  SemanticOctree octree;
  std::optional<NavigationGrid> navigation_grid = {};  ///< empty where no floor was found
};

/// Which object each instance of a key frame is, by the instance's number; kNoInstance = none.
using InstanceObjects = std::map<KeyframeId, std::vector<std::uint16_t>>;

/// Keeps the small cloud of each key frame in its camera's frame, and builds the map from them when
/// the poses are known: it is right after any loop closure. Not thread-safe.
class SemanticMapper {
 public:
  /// Throws Error where an option is out of its range.
  SemanticMapper(const PinholeCamera& camera, const DenseOptions& options);

  /// Keeps the static, labelled surface of a key frame and of views from nearby; the images are not
  /// kept. A key frame that is there already is replaced.
  void AddKeyframe(const LabelledFrame& keyframe, std::span<const LabelledFrame> views = {});
  /// Forgets a key frame; unknown ids do nothing.
  void RemoveKeyframe(KeyframeId id) { clouds_.erase(id); }

  /// Builds the whole map, key frames in the order of their ids. Key frames without a pose, or with
  /// one that is not usable (logged), are left out. The cloud keeps only points in voxels that are
  /// occupied in the end: what later rays cleared is in neither, nor what was seen in passing
  /// (passing_voxels.h). Its points are of an instance where `objects` knows it.
  SemanticMap Build(const KeyframePoseMap& world_from_camera,
                    const InstanceObjects& objects = {}) const;
  /// The same around the octree of these poses, which an OctreeIntegrator made.
  SemanticMap Complete(SemanticOctree octree, const KeyframePoseMap& world_from_camera,
                       const InstanceObjects& objects = {}) const;

  const KeyframeClouds& clouds() const { return clouds_; }

  /// Key frames that are held.
  std::size_t size() const { return clouds_.size(); }
  /// Of all clouds held.
  std::size_t MemoryBytes() const;
  const DenseOptions& options() const { return options_; }

 private:
  DenseOptions options_;
  KeyframeCloudMaker cloud_maker_;
  KeyframeClouds clouds_;
};

}  // namespace ofm
