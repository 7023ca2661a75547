#include "ofm/dense/semantic_octree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ofm/dense/voxel_ray.h"

namespace ofm {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

float LogOdds(double probability) {
  return static_cast<float>(std::log(probability / (1 - probability)));
}

std::uint8_t ToByte(float value) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

}  // namespace

SemanticOctree::Block::Block() { log_odds.fill(kUnknown); }

SemanticOctree::SemanticOctree(double resolution_m, const OccupancyOptions& options,
                               double label_share)
    : resolution_m_(resolution_m),
      options_(options),
      hit_(LogOdds(options.probability_hit)),
      miss_(LogOdds(options.probability_miss)),
      min_(LogOdds(options.probability_min)),
      max_(LogOdds(options.probability_max)),
      evidence_(resolution_m, label_share) {
  DenseOptions check;
  check.resolution_m = resolution_m;
  check.occupancy = options;
  CheckOptions(check);
}

VoxelIndex SemanticOctree::BlockOf(const VoxelIndex& voxel) {
  return {voxel.x() >> kBlockBits, voxel.y() >> kBlockBits, voxel.z() >> kBlockBits};
}

int SemanticOctree::CellOf(const VoxelIndex& voxel) {
  constexpr int kMask = (1 << kBlockBits) - 1;
  return (voxel.x() & kMask) << 2 * kBlockBits | (voxel.y() & kMask) << kBlockBits |
         (voxel.z() & kMask);
}

inline bool SemanticOctree::MarkUpdated(Block& block, int cell) const {
  if (block.updated_in != scan_) {
    block.updated.reset();
    block.updated_in = scan_;
  }
  if (block.updated[cell]) return false;
  block.updated[cell] = true;
  return true;
}

inline void SemanticOctree::Update(Block& block, int cell, float change) const {
  float& log_odds = block.log_odds[cell];
  log_odds = std::clamp((std::isnan(log_odds) ? 0 : log_odds) + change, min_, max_);
  if (log_odds <= min_ && block.surface[cell] != 0) {
    block.surfaces[block.surface[cell] - 1] = Surface();
  }
}

SemanticOctree::Block& SemanticOctree::BlockAt(const VoxelIndex& block) {
  const std::uint32_t number = table_.Insert(block);
  if (number == blocks_.size()) blocks_.emplace_back();
  return blocks_[number];
}

void SemanticOctree::FuseSurface(Block& block, int cell, const LabelledPoint& point) {
  if (block.surface[cell] == 0) {
    block.surfaces.emplace_back();
    block.surface[cell] = static_cast<std::uint16_t>(block.surfaces.size());
  }
  Surface& surface = block.surfaces[block.surface[cell] - 1];
  surface.points += 1;
  const Eigen::Vector3f color(point.color.r, point.color.g, point.color.b);
  surface.color += (color - surface.color) / surface.points;
  surface.labels.Add(point.class_id, evidence_(point));
}

std::vector<VoxelIndex> SemanticOctree::InsertHits(std::span<const LabelledPoint> points) {
  std::vector<VoxelIndex> hit_voxels;
  for (const LabelledPoint& point : points) {
    const std::optional<VoxelIndex> voxel = FindVoxel(point.position, 1 / resolution_m_);
    if (!voxel) continue;
    Block& block = BlockAt(BlockOf(*voxel));
    const int cell = CellOf(*voxel);
    if (MarkUpdated(block, cell)) {
      Update(block, cell, hit_);
      hit_voxels.push_back(*voxel);
    }
    FuseSurface(block, cell, point);
  }
  return hit_voxels;
}

void SemanticOctree::InsertMisses(const Eigen::Vector3f& origin, const Eigen::Vector3f& end) {
  VoxelIndex last = VoxelIndex::Constant(std::numeric_limits<int>::max());  // in no block
  Block* block = nullptr;
  TraverseRay(origin, end, resolution_m_, [&](const VoxelIndex& voxel) {
    const int changed_bits =
        (voxel.x() ^ last.x()) | (voxel.y() ^ last.y()) | (voxel.z() ^ last.z());
    if (changed_bits >> kBlockBits != 0) block = &BlockAt(BlockOf(voxel));
    last = voxel;
    const int cell = CellOf(voxel);
    if (MarkUpdated(*block, cell)) Update(*block, cell, miss_);
  });
}

bool SemanticOctree::InsertScan(const WorldScan& scan) {
  if (!FindVoxel(scan.origin, 1 / resolution_m_)) return false;
  ++scan_;
  for (const VoxelIndex& voxel : InsertHits(scan.points)) {
    InsertMisses(scan.origin, VoxelCenter(voxel, resolution_m_));
  }
  for (const Eigen::Vector3f& end : scan.free_ends) {
    if (FindVoxel(end, 1 / resolution_m_)) InsertMisses(scan.origin, end);
  }
  return true;
}

SemanticVoxel SemanticOctree::VoxelAt(const Block& block, int cell) {
  SemanticVoxel voxel{block.log_odds[cell], {}, kNoLabel, 0};
  if (block.surface[cell] == 0) return voxel;
  const Surface& surface = block.surfaces[block.surface[cell] - 1];
  voxel.color = {ToByte(surface.color[0]), ToByte(surface.color[1]), ToByte(surface.color[2])};
  voxel.class_id = surface.labels.Best();
  voxel.confidence = surface.labels.Confidence();
  return voxel;
}

std::optional<SemanticVoxel> SemanticOctree::Find(const VoxelIndex& voxel) const {
  if (voxel.minCoeff() < -kVoxelLimit || voxel.maxCoeff() >= kVoxelLimit) return {};
  const std::optional<std::uint32_t> number = table_.Find(BlockOf(voxel));
  if (!number) return {};
  const SemanticVoxel found = VoxelAt(blocks_[*number], CellOf(voxel));
  if (std::isnan(found.log_odds)) return {};
  return found;
}

std::optional<SemanticVoxel> SemanticOctree::Find(const Eigen::Vector3f& position_in_world) const {
  const std::optional<VoxelIndex> voxel = FindVoxel(position_in_world, 1 / resolution_m_);
  return voxel ? Find(*voxel) : std::nullopt;
}

bool SemanticOctree::IsOccupied(const Eigen::Vector3f& position_in_world) const {
  const std::optional<SemanticVoxel> voxel = Find(position_in_world);
  return voxel && voxel->IsOccupied();
}

void SemanticOctree::ForEach(
    const std::function<void(const VoxelIndex&, const SemanticVoxel&)>& visit) const {
  constexpr int kMask = (1 << kBlockBits) - 1;
  for (const std::uint32_t number : table_.SortedNumbers()) {
    const Block& block = blocks_[number];
    const VoxelIndex first = table_.At(number) * (1 << kBlockBits);
    for (int cell = 0; cell < kBlockVoxels; ++cell) {
      if (std::isnan(block.log_odds[cell])) continue;
      const VoxelIndex offset(cell >> 2 * kBlockBits, cell >> kBlockBits & kMask, cell & kMask);
      visit(first + offset, VoxelAt(block, cell));
    }
  }
}

std::size_t SemanticOctree::MemoryBytes() const {
  std::size_t bytes = table_.MemoryBytes() + blocks_.size() * sizeof(Block);
  for (const Block& block : blocks_) bytes += block.surfaces.capacity() * sizeof(Surface);
  return bytes;
}

}  // namespace ofm
