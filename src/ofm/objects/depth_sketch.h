// A key frame's depth, coarse: enough to know what it could see.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// Depth at every kStep_px-th pixel [m], row by row; 0 = not measured.
struct DepthSketch {
  static constexpr int kStep_px = 8;
  int columns = 0, rows = 0;
  std::vector<float> depth_m;

  /// Of cell (column, row), whose pixel is kStep_px times these, plus half of it.
  float At(int column, int row) const { return depth_m[row * columns + column]; }
};

/// `depth_m` is CV_32FC1; what is not finite counts as not measured.
DepthSketch SketchDepth(const cv::Mat& depth_m);

/// Where points are for a camera; the rest of them is out of its sight or not measured.
struct PointSight {
  int visible = 0;       ///< the surface seen there is at the point's depth
  int hidden = 0;        ///< something is before it
  int seen_through = 0;  ///< the camera looks through where the point is
};

struct SightOptions {
  double depth_tolerance_m = 0.06;  ///< and 2 % of the depth more
  int border_px = 12;               ///< nearer to the image's border a point is out of sight
};

PointSight FindSight(std::span<const Eigen::Vector3f> points_in_world,
                     const RigidTransform& camera_from_world, const DepthSketch& depth,
                     const PinholeCamera& camera, const SightOptions& options);

}  // namespace ofm
