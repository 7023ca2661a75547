// Occupancy, colour and label per voxel.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "ofm/dense/dense_options.h"
#include "ofm/dense/label_belief.h"
#include "ofm/dense/labelled_point.h"
#include "ofm/dense/voxel_table.h"

namespace ofm {

/// One voxel that rays have met.
struct SemanticVoxel {
  float log_odds = 0;  ///< of being occupied
  Rgb color;           ///< mean of the points in it; black where none fell in
  std::uint8_t class_id = kNoLabel;
  std::uint8_t confidence = 0;  ///< probability of class_id, 255 = sure

  /// More likely occupied than not, as OctoMap's default.
  bool IsOccupied() const { return log_odds >= 0; }
};

/// One scan in the world's frame [m].
struct WorldScan {
  Eigen::Vector3f origin;                  ///< the camera's centre
  std::vector<LabelledPoint> points;       ///< where rays end
  std::vector<Eigen::Vector3f> free_ends;  ///< rays to here only free
};

/// The map of voxels that becomes an OctoMap file (octree_file.h). In memory it is no tree but a
/// hash table of blocks of 8 x 8 x 8 voxels, which the rays cross several times faster; the
/// occupancies are those that octomap::OcTree::insertPointCloud with `discretize` gives, unless
/// neighbours are spared (OccupancyOptions). Labels are fused by Bayes' rule (LabelBelief).
class SemanticOctree {
 public:
  /// Each labelled point counts as `label_share` of an observation (PointEvidence).
  SemanticOctree(double resolution_m, const OccupancyOptions& options, double label_share = 1);

  /// Fuses a scan. Each voxel is updated once: as hit where a point is in it, else as missed where
  /// a ray crosses it and, where the options spare them, none of the 26 around was hit. There is
  /// one ray per voxel with points, to its centre. A voxel that has become as free as can be
  /// forgets colour and label. Returns false, and changes nothing, where the origin is not finite
  /// or beyond the grid's limits; such points are left out.
  bool InsertScan(const WorldScan& scan);

  /// The blocks of voxels that the last scan hit or crossed, by number; each once.
  const std::vector<std::uint32_t>& touched_blocks() const { return touched_; }
  /// The blocks that inserting the scan would touch; changes nothing that is known.
  std::vector<std::uint32_t> FindBlocks(const WorldScan& scan);
  /// Forgets all that is known in these blocks. Until EndRebuild scans change these alone: after
  /// the scans that touched them were inserted again, in the order of old, all voxels are as if
  /// only these scans had ever been.
  void BeginRebuild(std::span<const std::uint32_t> blocks);
  void EndRebuild();

  /// Makes voxels unknown, as if no ray had met them.
  void Forget(std::span<const VoxelIndex> voxels);

  /// Empty where no ray has been, or outside the grid's limits.
  std::optional<SemanticVoxel> Find(const VoxelIndex& voxel) const;
  std::optional<SemanticVoxel> Find(const Eigen::Vector3f& position_in_world) const;
  /// False where unknown.
  bool IsOccupied(const Eigen::Vector3f& position_in_world) const;

  /// Calls `visit` for every voxel that rays have met, in an order that does not depend on the
  /// order of the scans.
  void ForEach(const std::function<void(const VoxelIndex&, const SemanticVoxel&)>& visit) const;

  double resolution_m() const { return resolution_m_; }
  const OccupancyOptions& options() const { return options_; }
  /// True where nothing is known.
  bool empty() const;
  std::size_t MemoryBytes() const;

 private:
  static constexpr int kBlockBits = 3;
  static constexpr int kBlockVoxels = 1 << (3 * kBlockBits);

  /// What is known of a voxel that points fell in.
  struct Surface {
    Eigen::Vector3f color = Eigen::Vector3f::Zero();  // mean
    float points = 0;
    LabelBelief labels;
  };
  struct Block {
    Block();
    std::array<float, kBlockVoxels> log_odds;           // NaN = unknown
    std::array<std::uint16_t, kBlockVoxels> surface{};  // number + 1 in surfaces, 0 = none
    std::vector<Surface> surfaces;
    std::bitset<kBlockVoxels> updated;  // in scan `updated_in`
    std::uint32_t updated_in = 0;
    std::uint32_t number = 0;
    bool rebuilds = false;
  };
  /// What a scan may change.
  enum class Pass { kAll, kRebuilt, kNothing };

  static VoxelIndex BlockOf(const VoxelIndex& voxel);
  static int CellOf(const VoxelIndex& voxel);
  static SemanticVoxel VoxelAt(const Block& block, int cell);

  Block& TouchBlock(const VoxelIndex& block);
  void FuseSurface(Block& block, int cell, const LabelledPoint& point);
  template <Pass kPass>
  bool Insert(const WorldScan& scan);
  template <Pass kPass>
  std::vector<VoxelIndex> InsertHits(std::span<const LabelledPoint> points);
  template <Pass kPass>
  void InsertMisses(const Eigen::Vector3f& origin, const Eigen::Vector3f& end);
  void SpareNeighbours(const std::vector<VoxelIndex>& hit_voxels);
  void Update(Block& block, int cell, float change) const;

  double resolution_m_;
  OccupancyOptions options_;
  float hit_, miss_, min_, max_;  // log-odds
  PointEvidence evidence_;
  std::uint32_t scan_ = 0;
  VoxelTable table_;          // block coordinates to number in blocks_
  std::deque<Block> blocks_;  // references to blocks stay valid
  std::vector<std::uint32_t> touched_;
  std::optional<std::vector<std::uint32_t>> rebuilt_;  // between BeginRebuild and EndRebuild
};

}  // namespace ofm
