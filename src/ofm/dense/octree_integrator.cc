#include "ofm/dense/octree_integrator.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ofm {
namespace {

SemanticOctree MakeOctree(const DenseOptions& options) {
  return {options.resolution_m, options.occupancy, options.LabelShare()};
}

}  // namespace

bool IsUsablePose(const RigidTransform& world_from_camera, const DenseOptions& options) {
  const Eigen::Vector3f origin = world_from_camera.translation().cast<float>();
  return world_from_camera.IsFinite() && FindVoxel(origin, 1 / options.resolution_m);
}

double MapShift_m(const RigidTransform& before, const RigidTransform& after,
                  const DenseOptions& options) {
  const double turn = (after.RotationMatrix() - before.RotationMatrix()).norm() / std::sqrt(2.);
  return (after.translation() - before.translation()).norm() + turn * options.range_m / 2;
}

OctreeIntegrator::OctreeIntegrator(const DenseOptions& options)
    : options_(options), octree_(MakeOctree(options)) {}

IntegrationCounts OctreeIntegrator::Update(const KeyframeClouds& clouds,
                                           const KeyframePoseMap& world_from_camera,
                                           double tolerance_m) {
  Changes changes = FindChanges(clouds, world_from_camera, tolerance_m);
  IntegrationCounts counts{changes.added.size(), changes.moved.size(), changes.removed.size(), 0};
  if (counts.added + counts.moved + counts.removed == 0) return counts;
  const bool only_later =
      counts.moved + counts.removed == 0 &&
      (integrated_.empty() || integrated_.rbegin()->first < changes.added.begin()->first);
  if (only_later) {
    for (auto& [id, keyframe] : changes.added) {
      Insert(keyframe);
      integrated_.insert_or_assign(id, std::move(keyframe));
    }
    return counts;
  }
  const std::size_t before = integrated_.size();
  if (2 * (counts.moved + counts.removed) >= before) {
    for (const KeyframeId id : changes.removed) integrated_.erase(id);
    for (auto* changed : {&changes.added, &changes.moved}) {
      for (auto& [id, keyframe] : *changed) integrated_.insert_or_assign(id, std::move(keyframe));
    }
    InsertAllAnew();
    counts.reintegrated = before - counts.moved - counts.removed;
    return counts;
  }
  const std::size_t inserted = Rebuild(Apply(changes));
  counts.reintegrated = inserted - std::min(inserted, counts.moved + counts.added);
  return counts;
}

OctreeIntegrator::Changes OctreeIntegrator::FindChanges(const KeyframeClouds& clouds,
                                                        const KeyframePoseMap& world_from_camera,
                                                        double tolerance_m) const {
  Changes changes;
  for (const auto& [id, cloud] : clouds) {
    const auto pose = world_from_camera.find(id);
    if (pose == world_from_camera.end() || !IsUsablePose(pose->second, options_)) continue;
    const auto known = integrated_.find(id);
    if (known == integrated_.end()) {
      changes.added.emplace(id, Integrated{cloud, pose->second, {}});
    } else if (known->second.cloud != cloud ||
               MapShift_m(known->second.world_from_camera, pose->second, options_) > tolerance_m) {
      changes.moved.emplace(id, Integrated{cloud, pose->second, {}});
    }
  }
  for (const auto& [id, keyframe] : integrated_) {
    const auto pose = world_from_camera.find(id);
    const bool stays = clouds.contains(id) && pose != world_from_camera.end() &&
                       IsUsablePose(pose->second, options_);
    if (!stays) changes.removed.push_back(id);
  }
  return changes;
}

void OctreeIntegrator::Insert(Integrated& keyframe) {
  octree_.InsertScan(TransformToWorld(*keyframe.cloud, keyframe.world_from_camera));
  keyframe.blocks = octree_.touched_blocks();
}

void OctreeIntegrator::InsertAllAnew() {
  octree_ = MakeOctree(options_);
  for (auto& [id, keyframe] : integrated_) Insert(keyframe);
}

/// Gives the blocks that are wrong now, each once.
std::vector<std::uint32_t> OctreeIntegrator::Apply(const Changes& changes) {
  std::vector<std::uint32_t> wrong;
  const auto add = [&](const std::vector<std::uint32_t>& blocks) {
    wrong.insert(wrong.end(), blocks.begin(), blocks.end());
  };
  for (const KeyframeId id : changes.removed) {
    add(integrated_.at(id).blocks);
    integrated_.erase(id);
  }
  for (const auto* changed : {&changes.added, &changes.moved}) {
    for (const auto& [id, keyframe] : *changed) {
      Integrated& kept = integrated_[id];
      add(kept.blocks);
      kept = keyframe;
      kept.blocks = octree_.FindBlocks(TransformToWorld(*kept.cloud, kept.world_from_camera));
      add(kept.blocks);
    }
  }
  std::sort(wrong.begin(), wrong.end());
  wrong.erase(std::unique(wrong.begin(), wrong.end()), wrong.end());
  return wrong;
}

/// Gives the number of key frames that were gone through.
std::size_t OctreeIntegrator::Rebuild(const std::vector<std::uint32_t>& blocks) {
  const auto is_wrong = [&](std::uint32_t block) {
    return std::binary_search(blocks.begin(), blocks.end(), block);
  };
  std::size_t inserted = 0;
  octree_.BeginRebuild(blocks);
  for (const auto& [id, keyframe] : integrated_) {
    if (std::none_of(keyframe.blocks.begin(), keyframe.blocks.end(), is_wrong)) continue;
    octree_.InsertScan(TransformToWorld(*keyframe.cloud, keyframe.world_from_camera));
    ++inserted;
  }
  octree_.EndRebuild();
  return inserted;
}

SemanticOctree OctreeIntegrator::Take() {
  integrated_.clear();
  return std::exchange(octree_, MakeOctree(options_));
}

std::size_t OctreeIntegrator::MemoryBytes() const {
  std::size_t bytes = octree_.MemoryBytes();
  for (const auto& [id, keyframe] : integrated_) {
    bytes += sizeof(Integrated) + keyframe.blocks.capacity() * sizeof(keyframe.blocks[0]);
  }
  return bytes;
}

}  // namespace ofm
