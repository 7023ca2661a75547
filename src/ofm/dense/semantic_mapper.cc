#include "ofm/dense/semantic_mapper.h"

#include <spdlog/spdlog.h>

#include "ofm/base/check.h"
#include "ofm/dense/voxel_filter.h"

namespace ofm {

WorldScan TransformToWorld(const KeyframeCloud& cloud, const RigidTransform& world_from_camera) {
  const Eigen::Matrix3f rotation = world_from_camera.RotationMatrix().cast<float>();
  const Eigen::Vector3f origin = world_from_camera.translation().cast<float>();
  WorldScan scan{origin, cloud.points_in_camera, cloud.free_ends_in_camera};
  for (LabelledPoint& point : scan.points) point.position = rotation * point.position + origin;
  for (Eigen::Vector3f& end : scan.free_ends) end = rotation * end + origin;
  return scan;
}

SemanticMapper::SemanticMapper(const PinholeCamera& camera, const DenseOptions& options)
    : options_(options), cloud_maker_(camera, options) {}

void SemanticMapper::AddKeyframe(const LabelledFrame& frame) {
  OFM_CHECK(frame.id.valid());
  clouds_.insert_or_assign(frame.id, cloud_maker_.Make(frame));
}

SemanticMap SemanticMapper::Build(
    const std::map<KeyframeId, RigidTransform>& world_from_camera) const {
  SemanticMap map{{},
                  SemanticOctree(options_.resolution_m, options_.occupancy, options_.LabelShare())};
  ViewVoxelFilter filter(options_.CloudResolution());
  for (const auto& [id, cloud] : clouds_) {
    const auto pose = world_from_camera.find(id);
    if (pose == world_from_camera.end()) continue;
    const WorldScan scan = TransformToWorld(cloud, pose->second);
    if (!pose->second.IsFinite() || !map.octree.InsertScan(scan)) {
      spdlog::warn("semantic map: key frame {} is left out, its pose is not usable", id.value);
      continue;
    }
    for (const LabelledPoint& point : scan.points) filter.Add(point);
  }
  map.cloud_in_world = filter.Points();
  map.navigation_grid =
      MakeNavigationGrid(map.octree, MeanUp(world_from_camera), options_.navigation);
  std::erase_if(map.cloud_in_world,
                [&](const LabelledPoint& point) { return !map.octree.IsOccupied(point.position); });
  return map;
}

std::size_t SemanticMapper::MemoryBytes() const {
  std::size_t bytes = 0;
  for (const auto& [id, cloud] : clouds_) {
    bytes += sizeof(KeyframeCloud) + cloud.points_in_camera.capacity() * sizeof(LabelledPoint) +
             cloud.free_ends_in_camera.capacity() * sizeof(Eigen::Vector3f);
  }
  return bytes;
}

}  // namespace ofm
