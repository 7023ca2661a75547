#include "ofm/dense/octree_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "ofm/base/error.h"
#include "ofm/dense/label_color.h"
#include "ofm/io/read_file.h"

namespace ofm {
namespace {

/// A ColorOcTree that joins eight voxels only where their colours are equal too.
class ExactColorOcTree : public octomap::ColorOcTree {
 public:
  using ColorOcTree::ColorOcTree;

  bool isNodeCollapsible(const octomap::ColorOcTreeNode* node) const override {
    if (!nodeChildExists(node, 0)) return false;
    const octomap::ColorOcTreeNode* first = getNodeChild(node, 0);
    for (unsigned i = 0; i < 8; ++i) {
      if (!nodeChildExists(node, i)) return false;
      const octomap::ColorOcTreeNode* child = getNodeChild(node, i);
      if (nodeHasChildren(child) || !(*child == *first)) return false;
    }
    return true;
  }
};

octomap::OcTreeKey KeyOf(const VoxelIndex& voxel) {
  const auto part = [](int v) { return static_cast<octomap::key_type>(v + kVoxelLimit); };
  return {part(voxel.x()), part(voxel.y()), part(voxel.z())};
}

void SetSensorModel(octomap::AbstractOccupancyOcTree& tree, const OccupancyOptions& options) {
  tree.setProbHit(options.probability_hit);
  tree.setProbMiss(options.probability_miss);
  tree.setClampingThresMin(options.probability_min);
  tree.setClampingThresMax(options.probability_max);
}

constexpr const char* kOcTreeFile = "# Octomap OcTree file";
constexpr const char* kBinaryOcTreeFile = "# Octomap OcTree binary file";

/// The header as OctoMap's own write functions make it; these talk on the standard error stream.
void WriteHeader(std::ostream& stream, const char* first_line,
                 const octomap::AbstractOcTree& tree) {
  stream << first_line
         << "\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
         << fmt::format("id {}\nsize {}\nres {}\ndata\n", tree.getTreeType(), tree.size(),
                        tree.getResolution());
}

struct Header {
  std::string type;
  std::size_t nodes = 0;
  double resolution_m = 0;
};

/// Reads up to the line "data"; empty where this is no header.
std::optional<Header> ReadHeader(std::istream& stream) {
  std::string line;
  if (!std::getline(stream, line) || !line.starts_with(kOcTreeFile)) return {};
  Header header;
  while (std::getline(stream, line) && line != "data") {
    std::istringstream fields(line);
    std::string key;
    fields >> key;
    if (key == "id") fields >> header.type;
    if (key == "size") fields >> header.nodes;
    if (key == "res") fields >> header.resolution_m;
    if (key.starts_with('#')) continue;
    if (!fields) return {};
  }
  const bool sound = stream && std::isfinite(header.resolution_m) && header.resolution_m > 0;
  return sound ? std::optional(header) : std::nullopt;
}

void CheckWritten(const std::ostream& stream) {
  if (!stream) throw Error("the octree could not be written; is the disk full?");
}

}  // namespace

std::unique_ptr<octomap::ColorOcTree> MakeColorOcTree(const SemanticOctree& octree,
                                                      MapColor color) {
  auto tree = std::make_unique<ExactColorOcTree>(octree.resolution_m());
  SetSensorModel(*tree, octree.options());
  octree.ForEach([&](const VoxelIndex& index, const SemanticVoxel& voxel) {
    octomap::ColorOcTreeNode* node = tree->setNodeValue(KeyOf(index), voxel.log_odds, true);
    if (!voxel.IsOccupied()) return;
    const Rgb rgb = ChooseColor(color, voxel.color, voxel.class_id);
    node->setColor(rgb.r, rgb.g, rgb.b);
  });
  if (tree->getRoot() == nullptr) return tree;  // updateInnerOccupancy needs one
  tree->updateInnerOccupancy();
  tree->prune();
  return tree;
}

bool IsOccupied(const octomap::ColorOcTree& octree, const VoxelIndex& voxel) {
  if (voxel.minCoeff() < -kVoxelLimit || voxel.maxCoeff() >= kVoxelLimit) return false;
  const octomap::ColorOcTreeNode* node = octree.search(KeyOf(voxel));
  return node != nullptr && octree.isNodeOccupied(node);
}

void WriteColorOcTree(std::ostream& stream, const SemanticOctree& octree, MapColor color) {
  const auto tree = MakeColorOcTree(octree, color);
  WriteHeader(stream, kOcTreeFile, *tree);
  tree->writeData(stream);
  CheckWritten(stream);
}

std::unique_ptr<octomap::ColorOcTree> LoadColorOcTree(const std::filesystem::path& path) {
  std::istringstream stream(ReadFile(path));
  const std::optional<Header> header = ReadHeader(stream);
  if (!header || header->type != octomap::ColorOcTree(1).getTreeType()) {
    throw Error(path, "is no OctoMap file of a ColorOcTree");
  }
  auto tree = std::make_unique<octomap::ColorOcTree>(header->resolution_m);
  if (header->nodes == 0) return tree;
  stream.exceptions(std::ios::failbit | std::ios::badbit);  // OctoMap would read on past the end
  try {
    tree->readData(stream);
  } catch (const std::ios::failure&) {
    throw Error(path, "is truncated");
  }
  if (tree->size() != header->nodes) {
    throw Error(path, fmt::format("has {} nodes instead of {}", tree->size(), header->nodes));
  }
  return tree;
}

void WriteBinaryOcTree(std::ostream& stream, const SemanticOctree& octree) {
  octomap::OcTree tree(octree.resolution_m());
  SetSensorModel(tree, octree.options());
  octree.ForEach([&](const VoxelIndex& index, const SemanticVoxel& voxel) {
    tree.setNodeValue(KeyOf(index), voxel.log_odds, true);
  });
  tree.updateInnerOccupancy();
  tree.toMaxLikelihood();
  tree.prune();
  WriteHeader(stream, kBinaryOcTreeFile, tree);
  tree.writeBinaryData(stream);
  CheckWritten(stream);
}

void WriteVoxelLabels(std::ostream& stream, const SemanticOctree& octree,
                      std::span<const std::string> class_names) {
  stream << "x,y,z,class_id,class,confidence\n";
  octree.ForEach([&](const VoxelIndex& index, const SemanticVoxel& voxel) {
    if (!voxel.IsOccupied() || voxel.class_id == kNoLabel) return;
    const Eigen::Vector3f center = VoxelCenter(index, octree.resolution_m());
    std::string name = voxel.class_id < class_names.size() ? class_names[voxel.class_id] : "";
    std::replace(name.begin(), name.end(), ',', ' ');
    stream << fmt::format("{},{},{},{},{},{:.3f}\n", center.x(), center.y(), center.z(),
                          voxel.class_id, name, voxel.confidence / 255.);
  });
  CheckWritten(stream);
}

}  // namespace ofm
