// Clouds and octrees as a camera among them would show them.
#pragma once

#include <opencv2/core/mat.hpp>

#include "ofm/dense/dense_options.h"
#include "ofm/geometry/rigid_transform.h"
#include "ofm/report/cloud_file.h"
#include "ofm/report/voxel_file.h"

namespace ofm {

/// A pinhole camera: x to the right, y down, z ahead; its principal point is the image's centre.
struct Viewpoint {
  RigidTransform world_from_camera;
  cv::Size size = {960, 720};   ///< of the picture [px]
  double field_of_view = 1.13;  ///< horizontal [rad]
};

/// Where to stand to overlook what a camera at `world_from_camera` sees: `back_m` behind it and
/// `above_m` over it, looking at what is 2 m ahead of it.
RigidTransform Overlook(const RigidTransform& world_from_camera, double back_m, double above_m);

/// CV_8UC3, BGR, white where nothing is: each point as a square of 3 cm, the nearest in front.
/// With MapColor::kLabel points without a label keep their own colour, paler.
cv::Mat DrawCloud(const LabelledCloud& cloud, const Viewpoint& viewpoint, MapColor color);

/// The same of occupied voxels, as cubes.
cv::Mat DrawVoxels(const VoxelSet& voxels, const Viewpoint& viewpoint, MapColor color);

}  // namespace ofm
