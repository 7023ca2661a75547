#include "ofm/report/voxel_file.h"

#include <octomap/ColorOcTree.h>

#include <array>
#include <map>
#include <memory>

#include "ofm/dense/octree_file.h"
#include "ofm/io/table_file.h"

namespace ofm {
namespace {

using Key = std::array<octomap::key_type, 3>;

/// Labels by the key of the voxel at one depth of the tree.
using Labels = std::map<Key, std::uint8_t>;

Key KeyAtDepth(const octomap::ColorOcTree& tree, const octomap::OcTreeKey& key, unsigned depth) {
  const octomap::OcTreeKey at = tree.adjustKeyAtDepth(key, depth);
  return {at[0], at[1], at[2]};
}

struct LabelRow {
  octomap::OcTreeKey key;
  std::uint8_t class_id;
};

std::vector<LabelRow> LoadLabels(const std::filesystem::path& path,
                                 const octomap::ColorOcTree& tree) {
  std::vector<LabelRow> labels;
  if (!std::filesystem::exists(path)) return labels;
  const TableFile file(path);
  for (std::size_t i = 1; i < file.rows().size(); ++i) {  // the first one names the columns
    const TableFile::Row& row = file.rows()[i];
    if (row.fields.size() < 4) file.Fail(row, "has fewer fields than x,y,z,class_id");
    octomap::OcTreeKey key;
    const auto coordinate = [&](int axis) { return static_cast<float>(file.Number(row, axis)); };
    const octomap::point3d center(coordinate(0), coordinate(1), coordinate(2));
    const double class_id = file.Number(row, 3);
    if (class_id < 0 || class_id > kNoLabel) file.Fail(row, "has a class that is not in 0 to 255");
    if (!tree.coordToKeyChecked(center, key)) file.Fail(row, "is outside of the octree");
    labels.push_back({key, static_cast<std::uint8_t>(class_id)});
  }
  return labels;
}

/// The occupied leaves where the tree ends at `depth`; stops when there are too many.
VoxelSet CollectLeaves(const octomap::ColorOcTree& tree, unsigned depth, std::size_t max_voxels,
                       std::vector<Key>& keys, std::vector<unsigned>& depths) {
  VoxelSet set;
  set.resolution_m = tree.getResolution();
  keys.clear(), depths.clear();
  for (auto leaf = tree.begin_leafs(static_cast<unsigned char>(depth)); leaf != tree.end_leafs();
       ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    LabelledVoxel voxel;
    voxel.center = {static_cast<float>(leaf.getX()), static_cast<float>(leaf.getY()),
                    static_cast<float>(leaf.getZ())};
    voxel.size_exponent = static_cast<std::uint8_t>(tree.getTreeDepth() - leaf.getDepth());
    const octomap::ColorOcTreeNode::Color color = leaf->getColor();
    voxel.color = {color.r, color.g, color.b};
    set.voxels.push_back(voxel);
    keys.push_back(KeyAtDepth(tree, leaf.getKey(), leaf.getDepth()));
    depths.push_back(leaf.getDepth());
    if (set.voxels.size() > max_voxels) break;
  }
  return set;
}

}  // namespace

VoxelSet LoadVoxels(const std::filesystem::path& octree, const std::filesystem::path& labels,
                    std::size_t max_voxels) {
  const std::unique_ptr<octomap::ColorOcTree> tree = LoadColorOcTree(octree);
  const std::vector<LabelRow> rows = LoadLabels(labels, *tree);
  if (tree->size() == 0) return {tree->getResolution(), {}};
  VoxelSet set;
  std::vector<Key> keys;
  std::vector<unsigned> depths;
  for (unsigned depth = tree->getTreeDepth(); depth > 1; --depth) {
    set = CollectLeaves(*tree, depth, max_voxels, keys, depths);
    if (set.voxels.size() <= max_voxels) break;
  }
  std::map<unsigned, Labels> labels_at;  // by depth
  for (const unsigned depth : depths) {
    const auto [entry, is_new] = labels_at.try_emplace(depth);
    if (!is_new) continue;
    for (const LabelRow& row : rows) {
      entry->second.emplace(KeyAtDepth(*tree, row.key, depth), row.class_id);
    }
  }
  for (std::size_t i = 0; i < set.voxels.size(); ++i) {
    const Labels& known = labels_at[depths[i]];
    const auto found = known.find(keys[i]);
    if (found != known.end()) set.voxels[i].class_id = found->second;
  }
  return set;
}

}  // namespace ofm
