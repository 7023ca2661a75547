#include "ofm/dense/octree_file.h"

#include <gmock/gmock.h>

#include <sstream>

#include "ofm/base/error.h"
#include "ofm/dense/label_color.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using testing::HasSubstr;

/// A wall of 20 x 20 voxels, half of it chair, seen from before it.
SemanticOctree MakeWall(int scans) {
  SemanticOctree octree(.05, {});
  WorldScan scan{{.01f, .01f, .01f}, {}, {}};
  for (int x = -10; x < 10; ++x) {
    for (int y = -10; y < 10; ++y) {
      const Eigen::Vector3f position = VoxelCenter({x, y, 40}, .05);
      if (x < 0) scan.points.push_back({position, {30, 40, 50}, 56, 255});
      if (x >= 0) scan.points.push_back({position, {130, 140, 150}, kNoLabel, 128});
    }
  }
  for (int i = 0; i < scans; ++i) octree.InsertScan(scan);
  return octree;
}

octomap::OcTreeKey KeyOf(const VoxelIndex& v) {
  return {static_cast<octomap::key_type>(v.x() + kVoxelLimit),
          static_cast<octomap::key_type>(v.y() + kVoxelLimit),
          static_cast<octomap::key_type>(v.z() + kVoxelLimit)};
}

std::unique_ptr<octomap::ColorOcTree> ReadBack(const SemanticOctree& octree,
                                               MapColor color = MapColor::kAppearance) {
  std::stringstream stream;
  WriteColorOcTree(stream, octree, color);
  std::unique_ptr<octomap::AbstractOcTree> tree(octomap::AbstractOcTree::read(stream));
  EXPECT_NE(tree, nullptr);
  return std::unique_ptr<octomap::ColorOcTree>(dynamic_cast<octomap::ColorOcTree*>(tree.release()));
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(WriteColorOcTree, OctoMapReadsEveryVoxelBack) {
  const SemanticOctree octree = MakeWall(1);
  const auto tree = ReadBack(octree);
  ASSERT_NE(tree, nullptr);
  EXPECT_DOUBLE_EQ(tree->getResolution(), .05);
  std::size_t occupied = 0, free = 0;
  octree.ForEach([&](const VoxelIndex& index, const SemanticVoxel& voxel) {
    const octomap::ColorOcTreeNode* node = tree->search(KeyOf(index));
    ASSERT_NE(node, nullptr);
    EXPECT_FLOAT_EQ(node->getLogOdds(), voxel.log_odds);
    ASSERT_EQ(tree->isNodeOccupied(node), voxel.IsOccupied());
    if (voxel.IsOccupied()) {
      EXPECT_EQ(node->getColor(),
                octomap::ColorOcTreeNode::Color(voxel.color.r, voxel.color.g, voxel.color.b));
    }
    ++(voxel.IsOccupied() ? occupied : free);
  });
  EXPECT_EQ(occupied, 400u);
  EXPECT_GT(free, 2000u);
}

TEST(WriteColorOcTree, EqualVoxelsAreJoinedAndColorsAreNeverMixed) {
  const SemanticOctree octree = MakeWall(20);  // clamped: whole cubes of free space are equal
  const auto tree = ReadBack(octree);
  std::size_t voxels = 0;
  octree.ForEach([&](const VoxelIndex& index, const SemanticVoxel& voxel) {
    ++voxels;
    const octomap::ColorOcTreeNode* node = tree->search(KeyOf(index));
    ASSERT_NE(node, nullptr);
    if (voxel.IsOccupied()) {
      ASSERT_EQ(node->getColor().r, index.x() < 0 ? 30 : 130);
    }
  });
  EXPECT_LT(tree->getNumLeafNodes(), voxels);
}

TEST(WriteColorOcTree, VoxelsCanHaveTheColorOfTheirLabel) {
  const SemanticOctree octree = MakeWall(2);
  const auto tree = ReadBack(octree, MapColor::kLabel);
  ASSERT_NE(tree, nullptr);
  const auto color_at = [&](const VoxelIndex& voxel) {
    const auto color = tree->search(KeyOf(voxel))->getColor();
    return Rgb{color.r, color.g, color.b};
  };
  EXPECT_EQ(color_at({-3, 2, 40}), LabelColor(56));
  EXPECT_EQ(color_at({3, 2, 40}), LabelColor(kNoLabel));
  EXPECT_EQ(color_at({3, 2, 30}), (Rgb{255, 255, 255}));
}

TEST(WriteColorOcTree, AnEmptyMapIsAFileToo) {
  const auto tree = ReadBack(SemanticOctree(.05, {}));
  ASSERT_NE(tree, nullptr);
  EXPECT_EQ(tree->size(), 0u);
}

TEST(IsOccupied, IsFalseWhereFreeUnknownOrBeyondTheGrid) {
  const auto tree = MakeColorOcTree(MakeWall(1));
  EXPECT_TRUE(IsOccupied(*tree, {3, 2, 40}));
  EXPECT_FALSE(IsOccupied(*tree, {3, 2, 30}));
  EXPECT_FALSE(IsOccupied(*tree, {3, 2, 50}));
  EXPECT_FALSE(IsOccupied(*tree, {3, 2, 40 + 65536}));
}

TEST(LoadColorOcTree, ReadsWhatWasWrittenAndSaysNothing) {
  const TestFolder folder;
  std::ostringstream written;
  WriteColorOcTree(written, MakeWall(3));
  const auto path = folder.Write("map.ot", written.str());
  ::testing::internal::CaptureStderr();
  const auto tree = LoadColorOcTree(path);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_DOUBLE_EQ(tree->getResolution(), .05);
  EXPECT_TRUE(*tree == *MakeColorOcTree(MakeWall(3)));
}

TEST(LoadColorOcTree, ReadsAnEmptyMap) {
  const TestFolder folder;
  std::ostringstream written;
  WriteColorOcTree(written, SemanticOctree(.05, {}));
  EXPECT_EQ(LoadColorOcTree(folder.Write("map.ot", written.str()))->size(), 0u);
}

TEST(LoadColorOcTree, WhatIsNoSuchFileIsAnErrorThatNamesIt) {
  const TestFolder folder;
  std::ostringstream whole, binary;
  WriteColorOcTree(whole, MakeWall(1));
  WriteBinaryOcTree(binary, MakeWall(1));
  const std::string& bytes = whole.str();
  const auto error = [&](const std::string& contents) {
    const auto path = folder.Write("map.ot", contents);
    const std::string message = ErrorOf([&] { LoadColorOcTree(path); });
    EXPECT_THAT(message, testing::StartsWith(path.string() + ": "));
    return message;
  };
  EXPECT_THAT(error(bytes.substr(0, bytes.size() - 1)), HasSubstr("is truncated"));
  EXPECT_THAT(error(bytes.substr(0, bytes.size() / 2)), HasSubstr("is truncated"));
  for (const std::string& other :
       {std::string(), std::string("a text\n"), bytes.substr(0, 60), binary.str(),
        Replaced(bytes, "id ColorOcTree", "id OcTree"), Replaced(bytes, "res 0.05", "res zero"),
        Replaced(bytes, "res 0.05", "res -1")}) {
    EXPECT_THAT(error(other), HasSubstr("is no OctoMap file of a ColorOcTree"));
  }
  EXPECT_THAT(error(Replaced(bytes, "size ", "size 1")), HasSubstr(" nodes instead of 1"));
  EXPECT_THAT(ErrorOf([] { LoadColorOcTree("/no/map.ot"); }), HasSubstr("/no/map.ot: does not"));
}

TEST(WriteBinaryOcTree, OctoMapReadsFreeAndOccupiedBack) {
  const SemanticOctree octree = MakeWall(2);
  std::stringstream stream;
  WriteBinaryOcTree(stream, octree);
  octomap::OcTree tree(1);
  ASSERT_TRUE(tree.readBinary(stream));
  EXPECT_DOUBLE_EQ(tree.getResolution(), .05);
  octree.ForEach([&](const VoxelIndex& index, const SemanticVoxel& voxel) {
    const octomap::OcTreeNode* node = tree.search(KeyOf(index));
    ASSERT_NE(node, nullptr);
    ASSERT_EQ(tree.isNodeOccupied(node), voxel.IsOccupied());
  });
  EXPECT_EQ(tree.search(KeyOf({0, 0, 60})), nullptr);  // behind the wall
}

TEST(WriteBinaryOcTree, AnEmptyMapIsAFileToo) {
  std::stringstream stream;
  WriteBinaryOcTree(stream, SemanticOctree(.05, {}));
  octomap::OcTree tree(1);
  EXPECT_TRUE(tree.readBinary(stream));
  EXPECT_EQ(tree.size(), 0u);
}

TEST(WriteVoxelLabels, OneLinePerLabelledVoxel) {
  SemanticOctree octree(.05, {});
  octree.InsertScan({{0, 0, 0},
                     {{{.01f, .01f, 1.01f}, {}, 1, 255}, {{.3f, .01f, 1.01f}, {}, kNoLabel, 128}},
                     {}});
  std::ostringstream stream;
  const std::vector<std::string> names{"person", "chair, folding"};
  WriteVoxelLabels(stream, octree, names);
  EXPECT_EQ(stream.str(),
            "x,y,z,class_id,class,confidence\n0.025,0.025,1.025,1,chair  folding,0.988\n");
}

TEST(OctreeFiles, AStreamThatFailsIsAnError) {
  const SemanticOctree octree = MakeWall(1);
  std::ostream full(nullptr);
  EXPECT_THROW(WriteColorOcTree(full, octree), Error);
  EXPECT_THROW(WriteBinaryOcTree(full, octree), Error);
  EXPECT_THROW(WriteVoxelLabels(full, octree, {}), Error);
}

TEST(OctreeFiles, TheSameMapGivesTheSameBytes) {
  std::ostringstream a, b;
  WriteColorOcTree(a, MakeWall(3));
  WriteColorOcTree(b, MakeWall(3));
  EXPECT_EQ(a.str(), b.str());
}

}  // namespace
}  // namespace ofm
