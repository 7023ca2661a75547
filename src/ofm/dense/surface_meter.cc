#include "ofm/dense/surface_meter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ofm/base/check.h"
#include "ofm/camera/depth_noise.h"
#include "ofm/dense/octree_file.h"
#include "ofm/dense/usable_pixels.h"

namespace ofm {
namespace {

bool IsMapped(const octomap::ColorOcTree& octree, const VoxelIndex& voxel) {
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dz = -1; dz <= 1; ++dz) {
        if (IsOccupied(octree, voxel + VoxelIndex(dx, dy, dz))) return true;
      }
    }
  }
  return false;
}

}  // namespace

SurfaceMeter::SurfaceMeter(const PinholeCamera& camera, const SurfaceMeterOptions& options,
                           std::span<const LabelledPoint> points_in_map)
    : camera_(camera), table_(camera), options_(options) {
  OFM_CHECK(options.resolution_m > 0 && options.range_m > 0 && options.reach_m > 0);
  for (const LabelledPoint& point : points_in_map) points_.push_back({point.position});
}

void SurfaceMeter::AddFrame(const RigidTransform& map_from_camera, const cv::Mat& depth_m) {
  OFM_CHECK(depth_m.type() == CV_32FC1);
  OFM_CHECK(depth_m.cols == camera_.width && depth_m.rows == camera_.height);
  const cv::Mat usable = FindSmoothPixels(depth_m, {});
  ++frame_;
  AddVoxels(map_from_camera, depth_m, usable);
  AddOffsets(map_from_camera, depth_m, usable);
}

void SurfaceMeter::AddVoxels(const RigidTransform& map_from_camera, const cv::Mat& depth_m,
                             const cv::Mat& usable) {
  for (int row = 0; row < depth_m.rows; ++row) {
    for (int column = 0; column < depth_m.cols; ++column) {
      const double depth = depth_m.at<float>(row, column);
      if (usable.at<std::uint8_t>(row, column) == 0) continue;
      if (DepthSigma(depth) > options_.resolution_m / 2) continue;
      const Eigen::Vector3d point =
          camera_.UnprojectIdeal(table_.At(column, row).cast<double>(), depth);
      if (point.norm() > options_.range_m) continue;
      const std::optional<VoxelIndex> index =
          FindVoxel((map_from_camera * point).cast<float>(), 1 / options_.resolution_m);
      if (!index) continue;
      const std::uint32_t number = voxel_numbers_.Insert(*index);
      if (number == voxels_.size()) voxels_.emplace_back();
      Voxel& voxel = voxels_[number];
      if (voxel.last_frame != frame_) ++voxel.frames;
      voxel.last_frame = frame_;
    }
  }
}

void SurfaceMeter::AddOffsets(const RigidTransform& map_from_camera, const cv::Mat& depth_m,
                              const cv::Mat& usable) {
  const RigidTransform camera_from_map = map_from_camera.Inverse();
  const Eigen::Matrix3f rotation = camera_from_map.RotationMatrix().cast<float>();
  const Eigen::Vector3f translation = camera_from_map.translation().cast<float>();
  for (Point& point : points_) {
    const Eigen::Vector3f in_camera = rotation * point.position_in_map + translation;
    if (in_camera.z() <= 0 || in_camera.norm() > options_.range_m) continue;
    const Eigen::Vector2d ideal_px = camera_.ProjectIdeal(in_camera.cast<double>());
    // Far outside the image the distortion would fold back into it.
    const Eigen::Vector2d offset_px(ideal_px.x() - camera_.cx, ideal_px.y() - camera_.cy);
    if (offset_px.norm() > camera_.width) continue;
    const Eigen::Vector2d pixel = camera_.Distort(ideal_px);
    const double u = std::round(pixel.x()), v = std::round(pixel.y());
    if (!(u >= 0 && v >= 0 && u < camera_.width && v < camera_.height)) continue;
    const int row = static_cast<int>(v), column = static_cast<int>(u);
    if (usable.at<std::uint8_t>(row, column) == 0) continue;
    point.seen = true;
    const double measured_m = depth_m.at<float>(row, column);
    const double scale = in_camera.norm() / in_camera.z();  // of a length along the line of sight
    const double offset_m = scale * (measured_m - in_camera.z());
    if (std::abs(offset_m) > options_.reach_m) continue;
    const double sigma_m = DepthSigma(measured_m);
    point.weight += 1 / (sigma_m * sigma_m);
    point.weighted_offset += offset_m / (sigma_m * sigma_m);
  }
}

SurfaceMetrics SurfaceMeter::Evaluate(const octomap::ColorOcTree& octree) const {
  OFM_CHECK(std::abs(octree.getResolution() - options_.resolution_m) < 1e-9);
  SurfaceMetrics metrics;
  for (std::uint32_t number = 0; number < voxels_.size(); ++number) {
    if (voxels_[number].frames < options_.min_frames) continue;
    ++metrics.surface_voxels;
    metrics.mapped += IsMapped(octree, voxel_numbers_.At(number));
  }
  if (metrics.surface_voxels > 0) {
    metrics.mapped_share =
        static_cast<double>(metrics.mapped) / static_cast<double>(metrics.surface_voxels);
  }
  std::vector<double> distances_m;
  for (const Point& point : points_) {
    if (!point.seen) continue;
    const bool off = point.weight == 0;
    metrics.points_off += off;
    distances_m.push_back(off ? options_.reach_m : std::abs(point.weighted_offset / point.weight));
  }
  metrics.points = distances_m.size();
  if (!distances_m.empty()) {
    const auto middle = distances_m.begin() + static_cast<std::ptrdiff_t>(distances_m.size() / 2);
    std::nth_element(distances_m.begin(), middle, distances_m.end());
    metrics.median_distance_m = *middle;
  }
  return metrics;
}

}  // namespace ofm
