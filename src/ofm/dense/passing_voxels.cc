#include "ofm/dense/passing_voxels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <optional>

#include "ofm/dense/floor_plane.h"
#include "ofm/dense/log_odds.h"
#include "ofm/dense/octree_integrator.h"
#include "ofm/dense/voxel_table.h"

namespace ofm {
namespace {

/// The normal of the largest plane that is horizontal by what the cameras think is up; empty where
/// there is none, or where nothing moves and nobody asks.
std::optional<Eigen::Vector3d> FindVertical(const SemanticOctree& octree,
                                            const KeyframeClouds& clouds,
                                            const KeyframePoseMap& world_from_camera,
                                            FloorOptions options) {
  const bool nothing_moves = std::all_of(clouds.begin(), clouds.end(), [](const auto& entry) {
    return entry.second->movers_in_camera.empty();
  });
  if (nothing_moves) return {};
  options.max_share_beneath = 1;  // a desk tells the vertical as well as a floor does
  const auto plane = FindFloor(octree, MeanUp(world_from_camera), options);
  if (!plane) return {};
  return plane->normal;
}

/// The vertical columns in which something that moves was seen, and in which frames.
class Columns {
 public:
  explicit Columns(const Eigen::Vector3d& up) {
    axes_.row(0) = up.unitOrthogonal().cast<float>();
    axes_.row(1) = up.cast<float>().cross(axes_.row(0).transpose());
  }

  void Add(const std::vector<MoverPoint>& movers, const RigidTransform& world_from_movers) {
    for (const MoverPoint& mover : movers) {
      const auto cell = CellOf((world_from_movers * mover.position.cast<double>()).cast<float>());
      if (!cell) continue;
      const std::uint32_t number = cells_.Insert(*cell);
      if (number == seen_in_.size()) seen_in_.push_back(0);
      seen_in_[number] |= mover.seen_in;
    }
  }

  FrameBits At(const Eigen::Vector3f& position_in_world) const {
    const auto cell = CellOf(position_in_world);
    const auto number = cell ? cells_.Find(*cell) : std::nullopt;
    return number ? seen_in_[*number] : 0;
  }

 private:
  static constexpr double kSide_m = .1;

  std::optional<VoxelIndex> CellOf(const Eigen::Vector3f& position) const {
    const Eigen::Vector2f place = axes_ * position;
    return FindVoxel({place.x(), place.y(), 0}, 1 / kSide_m);
  }

  Eigen::Matrix<float, 2, 3> axes_;  // horizontal
  VoxelTable cells_;
  std::vector<FrameBits> seen_in_;  // by cell
};

/// How a voxel was seen.
struct Sighting {
  SeenSpan span;
  bool beside_mover = false;
  bool off_border = false;
};

/// How the clouds' points in each voxel were seen.
class SightingTable {
 public:
  explicit SightingTable(double resolution_m) : voxels_per_metre_(1 / resolution_m) {}

  void Add(const KeyframeCloud& cloud, const RigidTransform& world_from_camera,
           const std::optional<Eigen::Vector3d>& up_in_world) {
    Columns columns(up_in_world.value_or(Eigen::Vector3d::UnitZ()));
    if (up_in_world) columns.Add(cloud.movers_in_camera, world_from_camera);
    const std::vector<LabelledPoint> points = TransformToWorld(cloud, world_from_camera).points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto voxel = FindVoxel(points[i].position, voxels_per_metre_);
      if (!voxel) continue;
      const std::uint32_t number = voxels_.Insert(*voxel);
      if (number == sightings_.size()) sightings_.emplace_back();
      Sighting& sighting = sightings_[number];
      sighting.span = sighting.span.Joined(cloud.SpanOf(cloud.seen_in[i]));
      if (cloud.off_border[i] != 0) sighting.off_border = true;
      if ((columns.At(points[i].position) & cloud.seen_in[i]) != 0) sighting.beside_mover = true;
    }
  }

  template <class Predicate>
  std::vector<VoxelIndex> Select(const Predicate& is_wanted) const {
    std::vector<VoxelIndex> selected;
    for (std::uint32_t number = 0; number < sightings_.size(); ++number) {
      const VoxelIndex voxel = voxels_.At(number);
      if (is_wanted(voxel, sightings_[number])) selected.push_back(voxel);
    }
    return selected;
  }

 private:
  double voxels_per_metre_;
  VoxelTable voxels_;
  std::vector<Sighting> sightings_;  // by voxel
};

}  // namespace

std::vector<VoxelIndex> FindPassingVoxels(const SemanticOctree& octree,
                                          const KeyframeClouds& clouds,
                                          const KeyframePoseMap& world_from_camera,
                                          const DenseOptions& options) {
  if (options.passing.min_seen_s == 0) return {};
  const auto up = FindVertical(octree, clouds, world_from_camera, options.navigation.floor);
  SightingTable table(octree.resolution_m());
  for (const auto& [id, cloud] : clouds) {
    const auto pose = world_from_camera.find(id);
    if (pose == world_from_camera.end() || !IsUsablePose(pose->second, options)) continue;
    table.Add(*cloud, pose->second, up);
  }
  const double hit = LogOdds(options.occupancy.probability_hit);
  constexpr double kRounding = 1e-3;
  return table.Select([&](const VoxelIndex& voxel, const Sighting& sighting) {
    if (!sighting.beside_mover && sighting.off_border) return false;
    if (sighting.span.Seconds() >= options.passing.min_seen_s) return false;
    const auto known = octree.Find(voxel);
    return known && known->IsOccupied() &&
           known->log_odds <= options.passing.max_hits * hit + kRounding;
  });
}

}  // namespace ofm
