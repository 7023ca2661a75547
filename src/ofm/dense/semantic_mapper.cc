#include "ofm/dense/semantic_mapper.h"

#include <spdlog/spdlog.h>

#include "ofm/base/check.h"
#include "ofm/dense/octree_integrator.h"
#include "ofm/dense/passing_voxels.h"
#include "ofm/dense/surface_thinning.h"
#include "ofm/dense/voxel_filter.h"

namespace ofm {

namespace {

std::uint16_t FindObject(const InstanceObjects& objects, KeyframeId keyframe,
                         std::uint16_t instance) {
  const auto known = objects.find(keyframe);
  if (known == objects.end() || instance >= known->second.size()) return kNoInstance;
  return known->second[instance];
}

}  // namespace

SemanticMapper::SemanticMapper(const PinholeCamera& camera, const DenseOptions& options)
    : options_(options), cloud_maker_(camera, options) {}

void SemanticMapper::AddKeyframe(const LabelledFrame& keyframe,
                                 std::span<const LabelledFrame> views) {
  OFM_CHECK(keyframe.id.valid());
  clouds_.insert_or_assign(
      keyframe.id, std::make_shared<const KeyframeCloud>(cloud_maker_.Make(keyframe, views)));
}

SemanticMap SemanticMapper::Build(const KeyframePoseMap& world_from_camera,
                                  const InstanceObjects& objects) const {
  OctreeIntegrator integrator(options_);
  integrator.Update(clouds_, world_from_camera, 0);
  return Complete(integrator.Take(), world_from_camera, objects);
}

SemanticMap SemanticMapper::Complete(SemanticOctree octree,
                                     const KeyframePoseMap& world_from_camera,
                                     const InstanceObjects& objects) const {
  SemanticMap map{{}, std::move(octree)};
  map.octree.Forget(FindPassingVoxels(map.octree, clouds_, world_from_camera, options_));
  ViewVoxelFilter filter(options_.CloudResolution());
  for (const auto& [id, cloud] : clouds_) {
    const auto pose = world_from_camera.find(id);
    if (pose == world_from_camera.end()) continue;
    if (!IsUsablePose(pose->second, options_)) {
      spdlog::warn("semantic map: key frame {} is left out, its pose is not usable", id.value);
      continue;
    }
    const WorldScan scan = TransformToWorld(*cloud, pose->second);
    for (LabelledPoint point : scan.points) {
      point.instance = FindObject(objects, id, point.instance);
      filter.Add(point, scan.origin);
    }
  }
  map.cloud_in_world = ThinSurfaces(filter.Voxels(), options_.CloudResolution());
  map.navigation_grid =
      MakeNavigationGrid(map.octree, MeanUp(world_from_camera), options_.navigation);
  std::erase_if(map.cloud_in_world,
                [&](const LabelledPoint& point) { return !map.octree.IsOccupied(point.position); });
  return map;
}

std::size_t SemanticMapper::MemoryBytes() const {
  std::size_t bytes = 0;
  for (const auto& [id, cloud] : clouds_) {
    bytes += sizeof(KeyframeCloud) + cloud->points_in_camera.capacity() * sizeof(LabelledPoint) +
             cloud->free_ends_in_camera.capacity() * sizeof(Eigen::Vector3f) +
             cloud->seen_in.capacity() * sizeof(FrameBits) + cloud->off_border.capacity() +
             cloud->movers_in_camera.capacity() * sizeof(MoverPoint) +
             cloud->stamps_ns.capacity() * sizeof(std::int64_t);
  }
  return bytes;
}

}  // namespace ofm
