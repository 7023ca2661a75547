// How clean and how complete an octree is, against the truth.
#pragma once

#include <octomap/ColorOcTree.h>

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/dense/voxel_table.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

struct MapMetrics {
  std::size_t actor_only_voxels = 0;     ///< filled by actors' pixels and by no static one
  std::size_t actor_only_occupied = 0;   ///< of these, occupied in the octree
  double actor_residue_share = 0;        ///< occupied / all of them; 0 where there are none
  std::size_t static_voxels = 0;         ///< filled by static pixels of enough frames
  std::size_t static_occupied = 0;       ///< of these, occupied in the octree
  double static_coverage = 0;            ///< occupied / all of them; 0 where there are none
  std::size_t static_near_occupied = 0;  ///< of these, occupied or with an occupied face neighbour
  double static_coverage_near = 0;       ///< the same share; forgives depth noise of one voxel
};

struct MapMetricsOptions {
  double resolution_m = .05;  ///< of the octree
  double range_m = 5;         ///< pixels farther away are left out
  int min_static_frames = 3;  ///< that must see a voxel for it to count in static_coverage
};

/// Gathers which voxels truly are static and which only actors fill, from the depth images and the
/// true instance masks of a sequence (the more frames the better), and compares an octree with it.
/// A single static pixel makes a voxel one that the static scene fills.
class MapMetricsMeter {
 public:
  MapMetricsMeter(const PinholeCamera& camera, const MapMetricsOptions& options);

  /// `map_from_camera` is the true pose, brought to the octree's frame. depth_m: CV_32FC1 [m], 0 =
  /// none; instance_ids: CV_8UC1, 0 = static; empty = all static.
  void AddFrame(const RigidTransform& map_from_camera, const cv::Mat& depth_m,
                const cv::Mat& instance_ids);

  /// The octree as read from the file that is judged; its resolution must be that of the options.
  MapMetrics Evaluate(const octomap::ColorOcTree& octree) const;

 private:
  enum class Owner { kStatic, kActor };
  /// A voxel that any pixel fell in.
  struct Voxel {
    std::uint32_t static_frames = 0;
    std::uint32_t last_static_frame = 0;
  };

  void AddPoint(const Eigen::Vector3f& point_in_map, Owner owner);

  MapMetricsOptions options_;
  UndistortionTable table_;
  PinholeCamera camera_;
  std::uint32_t frame_ = 0;
  VoxelTable voxels_;
  std::vector<Voxel> states_;
};

}  // namespace ofm
