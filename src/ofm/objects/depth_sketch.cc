#include "ofm/objects/depth_sketch.h"

#include <cmath>

namespace ofm {

DepthSketch SketchDepth(const cv::Mat& depth_m) {
  constexpr int kStep = DepthSketch::kStep_px;
  DepthSketch sketch{depth_m.cols / kStep, depth_m.rows / kStep, {}};
  sketch.depth_m.reserve(static_cast<std::size_t>(sketch.columns) * sketch.rows);
  for (int row = 0; row < sketch.rows; ++row) {
    for (int column = 0; column < sketch.columns; ++column) {
      const float depth = depth_m.at<float>(row * kStep + kStep / 2, column * kStep + kStep / 2);
      sketch.depth_m.push_back(std::isfinite(depth) && depth > 0 ? depth : 0);
    }
  }
  return sketch;
}

PointSight FindSight(std::span<const Eigen::Vector3f> points_in_world,
                     const RigidTransform& camera_from_world, const DepthSketch& depth,
                     const PinholeCamera& camera, const SightOptions& options) {
  constexpr double kNear_m = 0.1, kToleranceShare = 0.02;
  PointSight sight;
  for (const Eigen::Vector3f& point : points_in_world) {
    const Eigen::Vector3d in_camera = camera_from_world * point.cast<double>().eval();
    if (in_camera.z() < kNear_m) continue;
    const Eigen::Vector2d ideal_px = camera.ProjectIdeal(in_camera);
    // Far outside, distortion models fold back into the image.
    if (ideal_px.x() < -camera.width || ideal_px.x() > 2 * camera.width ||
        ideal_px.y() < -camera.height || ideal_px.y() > 2 * camera.height) {
      continue;
    }
    const Eigen::Vector2d pixel = camera.Distort(ideal_px);
    const double border = options.border_px;
    if (pixel.x() < border || pixel.y() < border || pixel.x() > camera.width - 1 - border ||
        pixel.y() > camera.height - 1 - border) {
      continue;
    }
    const int column = static_cast<int>(pixel.x()) / DepthSketch::kStep_px;
    const int row = static_cast<int>(pixel.y()) / DepthSketch::kStep_px;
    if (column >= depth.columns || row >= depth.rows) continue;
    const double seen_m = depth.At(column, row);
    if (seen_m <= 0) continue;
    const double tolerance = options.depth_tolerance_m + kToleranceShare * in_camera.z();
    if (seen_m < in_camera.z() - tolerance) {
      ++sight.hidden;
    } else if (seen_m > in_camera.z() + tolerance) {
      ++sight.seen_through;
    } else {
      ++sight.visible;
    }
  }
  return sight;
}

}  // namespace ofm
