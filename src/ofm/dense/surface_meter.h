// How complete and how accurate a map is, against depth images of the room without actors.
#pragma once

#include <octomap/ColorOcTree.h>

#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/dense/labelled_point.h"
#include "ofm/dense/voxel_filter.h"
#include "ofm/dense/voxel_table.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

struct SurfaceMetrics {
  std::size_t surface_voxels = 0;  ///< that the static surface fills
  std::size_t mapped = 0;          ///< of these, occupied or with one of the 26 around occupied
  double mapped_share = 0;         ///< 0 where there are none
  std::size_t seen = 0;            ///< of the surface voxels, by frames that AddView told
  std::size_t seen_mapped = 0;     ///< of these, mapped
  std::size_t points = 0;          ///< of the map
  std::size_t points_off = 0;      ///< of these, with no static surface within reach_m
  double median_distance_m = 0;    ///< of all points, those off the surface at reach_m
};

struct SurfaceMeterOptions {
  double resolution_m = .05;  ///< of the octree; the surface is gathered in half of it
  double range_m = 5;         ///< pixels farther away are left out
  int min_frames = 3;         ///< that must see a voxel for the surface to be believed there
  double reach_m = .1;        ///< distance beyond which a point is on no surface
};

/// Gathers the static surface of a room from depth images that show nothing else, with true poses.
///
/// The surface is where the images put it together, not each of them: their pixels (no flying
/// pixels, no depth edges, within the range) are fused with their precision and thinned as
/// ThinSurfaces does, and stay where `min_frames` images agree on the voxel of the octree.
///
/// Seen: those of its voxels that hold static pixels of the recording that was mapped, or touch one
/// that does. What was never seen no map can have.
///
/// Voxels: those that hold a piece of the surface that was seen from so near that the standard
/// deviation of its depth is under half a voxel: what is farther says more of the sensor than of
/// the room.
///
/// Points: the distance of a point of the map from the surface is that from the plane through the
/// surface around its nearest point (point to plane), not more than that from the nearest point.
class SurfaceMeter {
 public:
  SurfaceMeter(const PinholeCamera& camera, const SurfaceMeterOptions& options);

  /// `map_from_camera` is the true pose when the depth image was taken, brought to the map's frame.
  /// depth_m: CV_32FC1 [m], 0 = none.
  void AddFrame(const RigidTransform& map_from_camera, const cv::Mat& depth_m);

  /// Of the recording that was mapped: `actors`, CV_8UC1, is not 0 where an actor is.
  void AddView(const RigidTransform& map_from_camera, const cv::Mat& depth_m,
               const cv::Mat& actors);

  /// Of the octree and the cloud as read from the files that are judged; the octree's resolution
  /// must be that of the options.
  SurfaceMetrics Evaluate(const octomap::ColorOcTree& octree,
                          std::span<const LabelledPoint> points_in_map) const;

 private:
  template <class Visit>
  void ForEachPoint(const RigidTransform& map_from_camera, const cv::Mat& depth_m,
                    Visit&& visit) const;

  struct Voxel {
    int frames = 0, last_frame = 0;
  };

  std::vector<LabelledPoint> FindSurface() const;

  PinholeCamera camera_;
  UndistortionTable table_;
  SurfaceMeterOptions options_;
  int frame_ = 0;
  VoxelTable voxel_numbers_;  // of the octree's size
  VoxelTable seen_;           // likewise
  std::vector<Voxel> voxels_;
  ViewVoxelFilter pixels_;
};

}  // namespace ofm
