// What was seen only in passing, where somebody stood.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ofm/dense/dense_options.h"
#include "ofm/dense/keyframe_cloud.h"
#include "ofm/dense/semantic_octree.h"

namespace ofm {

/// Occupied voxels that probably are of something that moves and that no mask covered there, as
/// feet under a table or an arm at the image's border: all frames that showed them lie within less
/// than PassingOptions::min_seen_s, few key frames hit them, and either something that moves was
/// straight over or under them in one of these frames (KeyframeCloud::movers_in_camera), or all
/// showed them at their border, which masks often do not reach. `octree` is that of these clouds at
/// these poses; each voxel is given once. Where it has no large horizontal plane the vertical is
/// not known, and the border alone counts.
std::vector<VoxelIndex> FindPassingVoxels(const SemanticOctree& octree,
                                          const KeyframeClouds& clouds,
                                          const KeyframePoseMap& world_from_camera,
                                          const DenseOptions& options);

}  // namespace ofm
