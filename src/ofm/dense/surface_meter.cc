#include "ofm/dense/surface_meter.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "ofm/base/check.h"
#include "ofm/base/median.h"
#include "ofm/camera/depth_noise.h"
#include "ofm/dense/octree_file.h"
#include "ofm/dense/surface_thinning.h"
#include "ofm/dense/usable_pixels.h"
#include "ofm/dense/voxel_lookup.h"

namespace ofm {
namespace {

/// Whether `is` holds for the voxel or one of the 26 around.
template <class Is>
bool HoldsNear(const VoxelIndex& voxel, Is&& is) {
  for (int i = 0; i < 27; ++i) {
    if (is(VoxelIndex(voxel + VoxelIndex(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1)))) return true;
  }
  return false;
}

/// Pixels are finer than the voxels that they are gathered in.
constexpr int kPixelStep = 2;

/// Finds distances from a surface given by points.
class SurfacePoints {
 public:
  SurfacePoints(std::span<const LabelledPoint> points, double spacing_m)
      : points_(points), spacing_m_(spacing_m), lookup_(spacing_m) {
    for (const LabelledPoint& point : points) lookup_.Add(point.position);
  }

  /// reach_m where there is nothing nearer.
  double DistanceFrom(const Eigen::Vector3f& position, double reach_m) const {
    const auto voxel = lookup_.VoxelOf(position);
    if (!voxel) return reach_m;
    const LabelledPoint* nearest = nullptr;
    double least_m = reach_m;
    for (int ring = 0; (ring - 1) * spacing_m_ < least_m; ++ring) {
      ForRing(*voxel, ring, [&](const LabelledPoint& point) {
        const double distance_m = (point.position - position).norm();
        if (distance_m >= least_m) return;
        least_m = distance_m;
        nearest = &point;
      });
    }
    return nearest == nullptr ? reach_m : std::min(least_m, DistanceFromPlane(position, *nearest));
  }

 private:
  /// Visits the points of the voxels that are `ring` voxels away.
  template <class Visit>
  void ForRing(const VoxelIndex& centre, int ring, Visit&& visit) const {
    for (int dx = -ring; dx <= ring; ++dx) {
      for (int dy = -ring; dy <= ring; ++dy) {
        const bool side = std::max(std::abs(dx), std::abs(dy)) == ring;
        for (int dz = -ring; dz <= ring; dz += side || ring == 0 ? 1 : 2 * ring) {
          const auto found = lookup_.Find(VoxelIndex(centre + VoxelIndex(dx, dy, dz)));
          if (found) visit(points_[*found]);
        }
      }
    }
  }

  double DistanceFromPlane(const Eigen::Vector3f& position, const LabelledPoint& nearest) const {
    constexpr int kRings = 2, kMinPoints = 4;
    std::vector<Eigen::Vector3d> around;
    const VoxelIndex centre = *lookup_.VoxelOf(nearest.position);
    for (int ring = 0; ring <= kRings; ++ring) {
      ForRing(centre, ring,
              [&](const LabelledPoint& point) { around.push_back(point.position.cast<double>()); });
    }
    if (around.size() < kMinPoints) return std::numeric_limits<double>::infinity();
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& point : around) mean += point / static_cast<double>(around.size());
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& point : around) {
      scatter += (point - mean) * (point - mean).transpose();
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(scatter);
    return std::abs(solver.eigenvectors().col(0).dot(position.cast<double>() - mean));
  }

  std::span<const LabelledPoint> points_;
  double spacing_m_;
  VoxelLookup lookup_;
};

double MedianOrZero(std::vector<double> values) {
  return values.empty() ? 0 : UpperMedian(std::move(values));
}

}  // namespace

SurfaceMeter::SurfaceMeter(const PinholeCamera& camera, const SurfaceMeterOptions& options)
    : camera_(camera), table_(camera), options_(options), pixels_(options.resolution_m / 2) {
  OFM_CHECK(options.resolution_m > 0 && options.range_m > 0 && options.reach_m > 0);
}

/// Visits row, column, depth [m] and place in the map of the smooth pixels in range.
template <class Visit>
void SurfaceMeter::ForEachPoint(const RigidTransform& map_from_camera, const cv::Mat& depth_m,
                                Visit&& visit) const {
  OFM_CHECK(depth_m.type() == CV_32FC1);
  OFM_CHECK(depth_m.cols == camera_.width && depth_m.rows == camera_.height);
  const cv::Mat usable = FindSmoothPixels(depth_m, {});
  for (int row = 0; row < depth_m.rows; row += kPixelStep) {
    for (int column = 0; column < depth_m.cols; column += kPixelStep) {
      const double depth = depth_m.at<float>(row, column);
      if (usable.at<std::uint8_t>(row, column) == 0) continue;
      const Eigen::Vector3d point =
          camera_.UnprojectIdeal(table_.At(column, row).cast<double>(), depth);
      if (point.norm() > options_.range_m) continue;
      const Eigen::Vector3f position = (map_from_camera * point).cast<float>();
      const auto voxel = FindVoxel(position, 1 / options_.resolution_m);
      if (voxel) visit(cv::Point(column, row), depth, position, *voxel);
    }
  }
}

void SurfaceMeter::AddFrame(const RigidTransform& map_from_camera, const cv::Mat& depth_m) {
  const Eigen::Vector3f viewpoint = map_from_camera.translation().cast<float>();
  ++frame_;
  ForEachPoint(
      map_from_camera, depth_m,
      [&](cv::Point, double depth, const Eigen::Vector3f& position, const VoxelIndex& index) {
        const std::uint32_t number = voxel_numbers_.Insert(index);
        if (number == voxels_.size()) voxels_.emplace_back();
        Voxel& voxel = voxels_[number];
        if (voxel.last_frame != frame_) ++voxel.frames;
        voxel.last_frame = frame_;
        LabelledPoint pixel;
        pixel.position = position;
        pixel.precision = static_cast<float>(1 / (DepthSigma(depth) * DepthSigma(depth)));
        pixels_.Add(pixel, viewpoint);
      });
}

void SurfaceMeter::AddView(const RigidTransform& map_from_camera, const cv::Mat& depth_m,
                           const cv::Mat& actors) {
  OFM_CHECK(actors.type() == CV_8UC1 && actors.size() == depth_m.size());
  ForEachPoint(map_from_camera, depth_m,
               [&](cv::Point pixel, double, const Eigen::Vector3f&, const VoxelIndex& voxel) {
                 if (actors.at<std::uint8_t>(pixel) == 0) seen_.Insert(voxel);
               });
}

std::vector<LabelledPoint> SurfaceMeter::FindSurface() const {
  std::vector<LabelledPoint> surface = ThinSurfaces(pixels_.Voxels(), options_.resolution_m / 2);
  std::erase_if(surface, [&](const LabelledPoint& point) {
    const auto voxel = FindVoxel(point.position, 1 / options_.resolution_m);
    const auto number = voxel ? voxel_numbers_.Find(*voxel) : std::nullopt;
    return !number || voxels_[*number].frames < options_.min_frames;
  });
  return surface;
}

SurfaceMetrics SurfaceMeter::Evaluate(const octomap::ColorOcTree& octree,
                                      std::span<const LabelledPoint> points_in_map) const {
  OFM_CHECK(std::abs(octree.getResolution() - options_.resolution_m) < 1e-9);
  const std::vector<LabelledPoint> surface = FindSurface();
  SurfaceMetrics metrics;
  VoxelTable counted;
  for (const LabelledPoint& point : surface) {
    if (1 / std::sqrt(point.precision) > options_.resolution_m / 2) continue;
    const auto voxel = FindVoxel(point.position, 1 / options_.resolution_m);
    if (counted.Insert(*voxel) < metrics.surface_voxels) continue;
    const bool mapped =
        HoldsNear(*voxel, [&](const VoxelIndex& near) { return IsOccupied(octree, near); });
    const bool seen =
        HoldsNear(*voxel, [&](const VoxelIndex& near) { return seen_.Find(near).has_value(); });
    ++metrics.surface_voxels;
    metrics.mapped += mapped;
    metrics.seen += seen;
    metrics.seen_mapped += seen && mapped;
  }
  if (metrics.surface_voxels > 0) {
    metrics.mapped_share =
        static_cast<double>(metrics.mapped) / static_cast<double>(metrics.surface_voxels);
  }
  const SurfacePoints nearest(surface, options_.resolution_m / 2);
  std::vector<double> distances_m;
  for (const LabelledPoint& point : points_in_map) {
    distances_m.push_back(nearest.DistanceFrom(point.position, options_.reach_m));
    metrics.points_off += distances_m.back() >= options_.reach_m;
  }
  metrics.points = distances_m.size();
  metrics.median_distance_m = MedianOrZero(std::move(distances_m));
  return metrics;
}

}  // namespace ofm
