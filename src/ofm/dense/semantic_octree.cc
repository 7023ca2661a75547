#include "ofm/dense/semantic_octree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ofm/base/check.h"
#include "ofm/dense/log_odds.h"
#include "ofm/dense/voxel_ray.h"

namespace ofm {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

std::uint8_t ToByte(float value) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

/// True the first time.
template <std::size_t kSize>
bool Mark(std::bitset<kSize>& marks, int cell) {
  const auto place = static_cast<std::size_t>(cell);
  if (marks[place]) return false;
  marks[place] = true;
  return true;
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

inline void SemanticOctree::Update(Block& block, int cell, float change) const {
  float& log_odds = block.log_odds[cell];
  log_odds = std::clamp((std::isnan(log_odds) ? 0 : log_odds) + change, min_, max_);
  if (log_odds <= min_ && block.surface[cell] != 0) {
    block.surfaces[block.surface[cell] - 1] = Surface();
  }
}

/// The block, made where it is new, with the marks of this scan.
SemanticOctree::Block& SemanticOctree::TouchBlock(const VoxelIndex& index) {
  const std::uint32_t number = table_.Insert(index);
  if (number == blocks_.size()) blocks_.emplace_back().number = number;
  Block& block = blocks_[number];
  if (block.updated_in != scan_) {
    block.updated.reset();
    block.updated_in = scan_;
    touched_.push_back(number);
  }
  return block;
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

template <SemanticOctree::Pass kPass>
std::vector<VoxelIndex> SemanticOctree::InsertHits(std::span<const LabelledPoint> points) {
  std::vector<VoxelIndex> hit_voxels;
  for (const LabelledPoint& point : points) {
    const std::optional<VoxelIndex> voxel = FindVoxel(point.position, 1 / resolution_m_);
    if (!voxel) continue;
    Block& block = TouchBlock(BlockOf(*voxel));
    const bool changes = kPass == Pass::kAll || (kPass == Pass::kRebuilt && block.rebuilds);
    const int cell = CellOf(*voxel);
    if (Mark(block.updated, cell)) {
      if (changes) Update(block, cell, hit_);
      hit_voxels.push_back(*voxel);
    }
    if (changes) FuseSurface(block, cell, point);
  }
  return hit_voxels;
}

template <SemanticOctree::Pass kPass>
void SemanticOctree::InsertMisses(const Eigen::Vector3f& origin, const Eigen::Vector3f& end) {
  VoxelIndex last = VoxelIndex::Constant(std::numeric_limits<int>::max());  // in no block
  Block* block = nullptr;
  TraverseRay(origin, end, resolution_m_, [&](const VoxelIndex& voxel) {
    const int changed_bits =
        (voxel.x() ^ last.x()) | (voxel.y() ^ last.y()) | (voxel.z() ^ last.z());
    if (changed_bits >> kBlockBits != 0) block = &TouchBlock(BlockOf(voxel));
    last = voxel;
    if (kPass == Pass::kNothing || (kPass == Pass::kRebuilt && !block->rebuilds)) return;
    const int cell = CellOf(voxel);
    if (Mark(block->updated, cell)) Update(*block, cell, miss_);
  });
}

/// Keeps this scan's rays from freeing what is beside its hits: errors of depth and pose put one
/// surface into neighbouring voxels, and a ray that grazes it must not take it away.
void SemanticOctree::SpareNeighbours(const std::vector<VoxelIndex>& hit_voxels) {
  for (const VoxelIndex& hit : hit_voxels) {
    for (int i = 0; i < 27; ++i) {
      const VoxelIndex voxel = hit + VoxelIndex(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1);
      Mark(TouchBlock(BlockOf(voxel)).updated, CellOf(voxel));
    }
  }
}

template <SemanticOctree::Pass kPass>
bool SemanticOctree::Insert(const WorldScan& scan) {
  if (!FindVoxel(scan.origin, 1 / resolution_m_)) return false;
  ++scan_;
  const std::vector<VoxelIndex> hit_voxels = InsertHits<kPass>(scan.points);
  if (options_.spare_neighbours) SpareNeighbours(hit_voxels);
  for (const VoxelIndex& voxel : hit_voxels) {
    InsertMisses<kPass>(scan.origin, VoxelCenter(voxel, resolution_m_));
  }
  for (const Eigen::Vector3f& end : scan.free_ends) {
    if (FindVoxel(end, 1 / resolution_m_)) InsertMisses<kPass>(scan.origin, end);
  }
  return true;
}

bool SemanticOctree::InsertScan(const WorldScan& scan) {
  touched_.clear();
  return rebuilt_ ? Insert<Pass::kRebuilt>(scan) : Insert<Pass::kAll>(scan);
}

std::vector<std::uint32_t> SemanticOctree::FindBlocks(const WorldScan& scan) {
  touched_.clear();
  Insert<Pass::kNothing>(scan);
  return touched_;
}

void SemanticOctree::BeginRebuild(std::span<const std::uint32_t> blocks) {
  OFM_CHECK(!rebuilt_);
  rebuilt_.emplace(blocks.begin(), blocks.end());
  for (const std::uint32_t number : *rebuilt_) {
    OFM_CHECK(number < blocks_.size());
    blocks_[number] = Block();
    blocks_[number].number = number;
    blocks_[number].rebuilds = true;
  }
}

void SemanticOctree::EndRebuild() {
  OFM_CHECK(rebuilt_);
  for (const std::uint32_t number : *rebuilt_) blocks_[number].rebuilds = false;
  rebuilt_.reset();
}

void SemanticOctree::Forget(std::span<const VoxelIndex> voxels) {
  for (const VoxelIndex& voxel : voxels) {
    const std::optional<std::uint32_t> number = table_.Find(BlockOf(voxel));
    if (!number) continue;
    Block& block = blocks_[*number];
    block.log_odds[CellOf(voxel)] = kUnknown;
    block.surface[CellOf(voxel)] = 0;
  }
}

bool SemanticOctree::empty() const {
  const auto is_known = [](float log_odds) { return !std::isnan(log_odds); };
  return std::none_of(blocks_.begin(), blocks_.end(), [&](const Block& block) {
    return std::any_of(block.log_odds.begin(), block.log_odds.end(), is_known);
  });
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
