#include "ofm/dense/map_metrics.h"

#include <cmath>

#include "ofm/base/check.h"
#include "ofm/dense/octree_file.h"

namespace ofm {
namespace {

bool HasOccupiedFaceNeighbor(const octomap::ColorOcTree& octree, const VoxelIndex& voxel) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int step : {-1, 1}) {
      if (IsOccupied(octree, voxel + step * VoxelIndex::Unit(axis))) return true;
    }
  }
  return false;
}

double Share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

MapMetricsMeter::MapMetricsMeter(const PinholeCamera& camera, const MapMetricsOptions& options)
    : options_(options), table_(camera), camera_(camera) {
  OFM_CHECK(options.resolution_m > 0 && options.range_m > 0);
}

void MapMetricsMeter::AddFrame(const RigidTransform& map_from_camera, const cv::Mat& depth_m,
                               const cv::Mat& instance_ids) {
  const cv::Size size(camera_.width, camera_.height);
  OFM_CHECK(depth_m.type() == CV_32FC1 && depth_m.size() == size);
  OFM_CHECK(instance_ids.empty() ||
            (instance_ids.type() == CV_8UC1 && instance_ids.size() == size));
  ++frame_;
  for (int row = 0; row < depth_m.rows; ++row) {
    for (int column = 0; column < depth_m.cols; ++column) {
      const double depth = depth_m.at<float>(row, column);
      if (!(depth > 0)) continue;
      const Eigen::Vector3d point =
          camera_.UnprojectIdeal(table_.At(column, row).cast<double>(), depth);
      if (!(point.norm() <= options_.range_m)) continue;
      const bool actor = !instance_ids.empty() && instance_ids.at<std::uint8_t>(row, column) != 0;
      AddPoint((map_from_camera * point).cast<float>(), actor ? Owner::kActor : Owner::kStatic);
    }
  }
}

void MapMetricsMeter::AddPoint(const Eigen::Vector3f& point_in_map, Owner owner) {
  const std::optional<VoxelIndex> voxel = FindVoxel(point_in_map, 1 / options_.resolution_m);
  if (!voxel) return;
  const std::uint32_t number = voxels_.Insert(*voxel);
  if (number == states_.size()) states_.emplace_back();
  Voxel& state = states_[number];
  if (owner == Owner::kStatic && state.last_static_frame != frame_) {
    state.last_static_frame = frame_;
    ++state.static_frames;
  }
}

MapMetrics MapMetricsMeter::Evaluate(const octomap::ColorOcTree& octree) const {
  OFM_CHECK(std::abs(octree.getResolution() - options_.resolution_m) < 1e-9);
  MapMetrics metrics;
  for (std::uint32_t number = 0; number < states_.size(); ++number) {
    const Voxel& state = states_[number];
    const bool occupied = IsOccupied(octree, voxels_.At(number));
    if (state.static_frames == 0) {
      ++metrics.actor_only_voxels;
      metrics.actor_only_occupied += occupied;
    } else if (state.static_frames >= static_cast<std::uint32_t>(options_.min_static_frames)) {
      ++metrics.static_voxels;
      metrics.static_occupied += occupied;
      metrics.static_near_occupied +=
          occupied || HasOccupiedFaceNeighbor(octree, voxels_.At(number));
    }
  }
  metrics.actor_residue_share = Share(metrics.actor_only_occupied, metrics.actor_only_voxels);
  metrics.static_coverage = Share(metrics.static_occupied, metrics.static_voxels);
  metrics.static_coverage_near = Share(metrics.static_near_occupied, metrics.static_voxels);
  return metrics;
}

}  // namespace ofm
