// How complete and how accurate a map is, against depth images of the room without actors.
#pragma once

#include <octomap/ColorOcTree.h>

#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/dense/labelled_point.h"
#include "ofm/dense/voxel_table.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

struct SurfaceMetrics {
  std::size_t surface_voxels = 0;  ///< that the static surface fills
  std::size_t mapped = 0;          ///< of these, occupied or with one of the 26 around occupied
  double mapped_share = 0;         ///< 0 where there are none
  std::size_t points = 0;          ///< of the map, in sight of the depth images
  std::size_t points_off = 0;      ///< of these, with no static surface within reach_m
  double median_distance_m = 0;    ///< of all these points, those off the surface at the end
};

struct SurfaceMeterOptions {
  double resolution_m = .05;  ///< of the octree
  double range_m = 5;         ///< pixels farther away are left out
  int min_frames = 3;         ///< that must see a voxel for it to be a part of the surface
  double reach_m = .1;        ///< distance beyond which a point is on no surface
};

/// Gathers the static surface of a room from depth images that show nothing else, with true poses.
///
/// Voxels: a voxel is the surface's where pixels of `min_frames` images fall in it. Only pixels
/// count that are no flying pixels and no depth edges, within the range, and so near that the
/// standard deviation of their depth is under half a voxel: what is farther says more of the
/// sensor than of the room.
///
/// Points: each point of the map is looked at from each image. Its distance is the mean, weighted
/// by 1 / variance, of how much nearer or farther the depth measured behind its pixel is, over the
/// images that measured something within `reach_m` of it: along the line of sight, which is at
/// least the distance from the surface, and without the noise of a single image.
class SurfaceMeter {
 public:
  /// `points_in_map` are the map's.
  SurfaceMeter(const PinholeCamera& camera, const SurfaceMeterOptions& options,
               std::span<const LabelledPoint> points_in_map);

  /// `map_from_camera` is the true pose, brought to the map's frame. depth_m: CV_32FC1 [m], 0 =
  /// none.
  void AddFrame(const RigidTransform& map_from_camera, const cv::Mat& depth_m);

  /// The octree as read from the file that is judged; its resolution must be that of the options.
  SurfaceMetrics Evaluate(const octomap::ColorOcTree& octree) const;

 private:
  struct Voxel {
    int frames = 0, last_frame = 0;
  };
  struct Point {
    Eigen::Vector3f position_in_map;
    double weight = 0, weighted_offset = 0;  // of the surface along the line of sight
    bool seen = false;
  };

  void AddVoxels(const RigidTransform& map_from_camera, const cv::Mat& depth_m,
                 const cv::Mat& usable);
  void AddOffsets(const RigidTransform& map_from_camera, const cv::Mat& depth_m,
                  const cv::Mat& usable);

  PinholeCamera camera_;
  UndistortionTable table_;
  SurfaceMeterOptions options_;
  int frame_ = 0;
  VoxelTable voxel_numbers_;
  std::vector<Voxel> voxels_;
  std::vector<Point> points_;
};

}  // namespace ofm
