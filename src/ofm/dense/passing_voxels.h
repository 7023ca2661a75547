// What was seen only in passing, where somebody stood.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ofm/dense/dense_options.h"
#include "ofm/dense/keyframe_cloud.h"
#include "ofm/dense/semantic_octree.h"

namespace ofm {

/// Occupied voxels that probably are of something that moves and that no mask covered there, as
/// feet under a table: in a frame that showed them something that moves was straight over or under
/// them (KeyframeCloud::movers_in_camera), all frames that showed them lie within less than
/// PassingOptions::min_seen_s, and few key frames hit them. `octree` is that of these clouds at
/// these poses; each voxel is given once. Nothing is found where it has no large horizontal plane
/// that tells the vertical.
std::vector<VoxelIndex> FindPassingVoxels(const SemanticOctree& octree,
                                          const KeyframeClouds& clouds,
                                          const KeyframePoseMap& world_from_camera,
                                          const DenseOptions& options);

}  // namespace ofm
