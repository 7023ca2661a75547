#include "ofm/dense/semantic_octree.h"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ofm/base/error.h"
#include "ofm/base/random.h"

namespace ofm {
namespace {

constexpr double kResolution_m = .1;
const Eigen::Vector3f kOrigin(.05f, .05f, .05f);
/// In the voxel (10, 0, 0), ten voxels from the origin's.
const Eigen::Vector3f kEnd(1.05f, .05f, .05f);

/// Rays free whatever they cross.
OccupancyOptions AsOctoMap() {
  OccupancyOptions options;
  options.spare_neighbours = false;
  return options;
}

float LogOdds(double probability) {
  return static_cast<float>(std::log(probability / (1 - probability)));
}

WorldScan ScanTo(const Eigen::Vector3f& end, std::uint8_t class_id = kNoLabel,
                 std::uint8_t confidence = 200) {
  return {kOrigin, {{end, {100, 150, 200}, class_id, confidence}}, {}};
}

WorldScan RandomScan(std::uint64_t seed) {
  RandomEngine engine = MakeRandomEngine(seed, 0);
  const auto uniform = [&](double low, double high) {
    return static_cast<float>(low + (high - low) * UniformReal(engine));
  };
  WorldScan scan{{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}, {}, {}};
  for (int i = 0; i < 500; ++i) {
    scan.points.push_back(
        {{uniform(-4, 4), uniform(-4, 4), uniform(1, 3)}, {}, static_cast<std::uint8_t>(i), 99});
  }
  return scan;
}

TEST(SemanticOctree, ARayFillsItsEndAndFreesWhatIsBefore) {
  SemanticOctree octree(kResolution_m, AsOctoMap());
  ASSERT_TRUE(octree.InsertScan(ScanTo(kEnd)));
  EXPECT_FLOAT_EQ(octree.Find(kEnd)->log_odds, LogOdds(.7));
  for (int x = 0; x < 10; ++x) {
    EXPECT_FLOAT_EQ(octree.Find(VoxelIndex(x, 0, 0))->log_odds, LogOdds(.4));
  }
  EXPECT_FALSE(octree.Find(VoxelIndex(11, 0, 0)));
  EXPECT_FALSE(octree.Find(VoxelIndex(5, 1, 0)));
}

TEST(SemanticOctree, ARayThatGrazesASurfaceOfItsScanDoesNotFreeIt) {
  // A floor that another scan put one voxel higher.
  WorldScan floor{{.05f, .05f, .35f}, {}, {}};
  WorldScan higher = floor;
  for (int x = 2; x <= 20; ++x) {
    floor.points.push_back({{.1f * static_cast<float>(x) + .05f, .05f, .05f}, {}, kNoLabel, 0});
    higher.points.push_back({{.1f * static_cast<float>(x) + .05f, .05f, .15f}, {}, kNoLabel, 0});
  }
  const auto count_left = [&](const OccupancyOptions& options) {
    SemanticOctree octree(kResolution_m, options);
    octree.InsertScan(higher);
    for (int i = 0; i < 5; ++i) octree.InsertScan(floor);
    return std::count_if(higher.points.begin(), higher.points.end(),
                         [&](const auto& point) { return octree.IsOccupied(point.position); });
  };
  EXPECT_EQ(count_left({}), 19);
  EXPECT_LT(count_left(AsOctoMap()), 10);
}

TEST(SemanticOctree, LogOddsAreClamped) {
  SemanticOctree octree(kResolution_m, {});
  for (int i = 0; i < 20; ++i) octree.InsertScan(ScanTo(kEnd));
  EXPECT_FLOAT_EQ(octree.Find(kEnd)->log_odds, LogOdds(.971));
  EXPECT_FLOAT_EQ(octree.Find(kOrigin)->log_odds, LogOdds(.1192));
}

TEST(SemanticOctree, AVoxelIsUpdatedOncePerScanAndHitsWin) {
  SemanticOctree octree(kResolution_m, {});
  WorldScan scan = ScanTo(kEnd);
  scan.points.push_back({{1.06f, .06f, .06f}, {}, kNoLabel, 0});  // the same voxel
  scan.points.push_back({{2.05f, .05f, .05f}, {}, kNoLabel, 0});  // behind it
  octree.InsertScan(scan);
  EXPECT_FLOAT_EQ(octree.Find(kEnd)->log_odds, LogOdds(.7));
  EXPECT_FLOAT_EQ(octree.Find(kOrigin)->log_odds, LogOdds(.4));
}

TEST(SemanticOctree, OccupancyIsThatOfOctoMap) {
  SemanticOctree octree(kResolution_m, AsOctoMap());
  octomap::OcTree reference(kResolution_m);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const WorldScan scan = RandomScan(seed);
    octree.InsertScan(scan);
    octomap::Pointcloud cloud;
    for (const LabelledPoint& p : scan.points) {
      cloud.push_back(p.position.x(), p.position.y(), p.position.z());
    }
    const octomap::point3d origin(scan.origin.x(), scan.origin.y(), scan.origin.z());
    reference.insertPointCloud(cloud, origin, -1, false, true);
  }
  reference.expand();
  std::size_t voxels = 0;
  octree.ForEach([&](const VoxelIndex& v, const SemanticVoxel& voxel) {
    ++voxels;
    const octomap::OcTreeNode* node = reference.search(
        octomap::OcTreeKey(v.x() + kVoxelLimit, v.y() + kVoxelLimit, v.z() + kVoxelLimit));
    ASSERT_NE(node, nullptr);
    ASSERT_EQ(voxel.log_odds, node->getLogOdds());
  });
  EXPECT_EQ(voxels, reference.getNumLeafNodes());
  EXPECT_GT(voxels, 10000u);
}

TEST(SemanticOctree, SomebodyWhoStoodThereIsClearedByRaysThatPass) {
  SemanticOctree octree(kResolution_m, {});
  const Eigen::Vector3f wall(2.05f, .05f, .05f);
  for (int i = 0; i < 3; ++i) octree.InsertScan(ScanTo(kEnd, 0, 250));
  ASSERT_TRUE(octree.IsOccupied(kEnd));
  int scans = 0;
  while (octree.IsOccupied(kEnd) && scans < 100) {
    octree.InsertScan(ScanTo(wall));
    ++scans;
  }
  EXPECT_EQ(scans, 7);  // 3 x .847 / .405, rounded up
  EXPECT_EQ(octree.Find(kEnd)->class_id, 0);
  for (int i = 0; i < 5; ++i) octree.InsertScan(ScanTo(wall));
  EXPECT_EQ(octree.Find(kEnd)->class_id, kNoLabel);  // surely free: forgotten
  EXPECT_TRUE(octree.IsOccupied(wall));
}

TEST(SemanticOctree, AForgottenVoxelIsUnknownAndItsNeighboursAreNot) {
  SemanticOctree octree(.1, {});
  const Eigen::Vector3f here(.05f, .05f, 1.05f), beside(.15f, .05f, 1.05f);
  WorldScan scan{Eigen::Vector3f(.05f, .05f, .05f), {}, {}};
  for (const Eigen::Vector3f& place : {here, beside}) {
    scan.points.push_back({place, {200, 20, 30}, 7, 200});
  }
  octree.InsertScan(scan);
  ASSERT_TRUE(octree.IsOccupied(here));
  const std::vector<VoxelIndex> forgotten{{0, 0, 10}, {500, 0, 0}};  // the second never was known
  octree.Forget(forgotten);
  EXPECT_FALSE(octree.Find(here));
  EXPECT_TRUE(octree.IsOccupied(beside));
  octree.InsertScan(scan);
  EXPECT_EQ(octree.Find(here)->log_odds, octree.Find(beside)->log_odds / 2);
  EXPECT_EQ(octree.Find(here)->class_id, 7);
}

TEST(SemanticOctree, RaysToFreeEndsFillNothing) {
  SemanticOctree octree(kResolution_m, {});
  octree.InsertScan({kOrigin, {}, {kEnd}});
  EXPECT_FALSE(octree.Find(kEnd));
  EXPECT_FLOAT_EQ(octree.Find(VoxelIndex(9, 0, 0))->log_odds, LogOdds(.4));
}

TEST(SemanticOctree, LabelsAndColorsAreFused) {
  SemanticOctree octree(kResolution_m, {});
  octree.InsertScan({kOrigin, {{kEnd, {100, 0, 10}, 3, 51}}, {}});
  octree.InsertScan({kOrigin, {{kEnd, {200, 1, 10}, 5, 250}}, {}});
  EXPECT_EQ(octree.Find(kEnd)->class_id, 5);
  octree.InsertScan({kOrigin, {{kEnd, {150, 2, 10}, 3, 204}}, {}});
  const SemanticVoxel voxel = *octree.Find(kEnd);
  EXPECT_EQ(voxel.class_id, 3);
  // Two doubtful views agree: .25 x 80 x 4 x 80 against 50 x 80 and 79 others.
  EXPECT_EQ(voxel.confidence, std::lround(255 * 6400. / (6400 + 4000 + 79)));
  EXPECT_EQ(voxel.color, (Rgb{150, 1, 10}));
}

TEST(SemanticOctree, LabelsOfUncertainDepthCountLess) {
  const auto fused = [](float precision) {
    SemanticOctree octree(kResolution_m, {});
    octree.InsertScan({kOrigin, {{kEnd, {}, 3, 128}}, {}});
    octree.InsertScan({kOrigin, {{kEnd, {}, 5, 230, kNoInstance, precision}}, {}});
    return octree.Find(kEnd)->class_id;
  };
  EXPECT_EQ(fused(1e6f), 5);
  EXPECT_EQ(fused(1 / (.08f * .08f)), 3);  // +- 8 cm in a voxel of 10 cm
}

TEST(SemanticOctree, PointsOfOneViewCanShareAnObservation) {
  SemanticOctree octree(kResolution_m, {}, .25);
  octree.InsertScan({kOrigin, std::vector<LabelledPoint>(4, {kEnd, {}, 3, 204}), {}});
  EXPECT_EQ(octree.Find(kEnd)->class_id, 3);
  EXPECT_EQ(octree.Find(kEnd)->confidence, 204);
}

TEST(SemanticOctree, VoxelsComeInAnOrderThatDoesNotDependOnTheScans) {
  const auto order = [](std::uint64_t first, std::uint64_t second) {
    SemanticOctree octree(kResolution_m, {});
    octree.InsertScan(RandomScan(first));
    octree.InsertScan(RandomScan(second));
    std::vector<VoxelIndex> voxels;
    octree.ForEach([&](const VoxelIndex& v, const SemanticVoxel&) { voxels.push_back(v); });
    return voxels;
  };
  EXPECT_EQ(order(1, 2), order(2, 1));
}

TEST(SemanticOctree, WhatIsOutsideTheGridIsLeftOut) {
  SemanticOctree octree(kResolution_m, {});
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(octree.InsertScan({{kNan, 0, 0}, {{kEnd, {}, 1, 1}}, {}}));
  EXPECT_FALSE(octree.InsertScan({{0, 1e9f, 0}, {{kEnd, {}, 1, 1}}, {}}));
  EXPECT_TRUE(octree.empty());
  EXPECT_TRUE(octree.InsertScan({kOrigin, {{{0, kNan, 0}, {}, 1, 1}}, {{0, 0, 1e9f}}}));
  EXPECT_TRUE(octree.empty());
  EXPECT_FALSE(octree.Find(Eigen::Vector3f(kNan, 0, 0)));
  EXPECT_FALSE(octree.Find(VoxelIndex(40000, 0, 0)));
}

std::vector<float> Occupancies(const SemanticOctree& octree) {
  std::vector<float> values;
  octree.ForEach([&](const VoxelIndex& v, const SemanticVoxel& voxel) {
    for (const int coordinate : v) values.push_back(static_cast<float>(coordinate));
    values.insert(values.end(), {voxel.log_odds, static_cast<float>(voxel.class_id),
                                 static_cast<float>(voxel.confidence)});
  });
  return values;
}

TEST(SemanticOctree, BlocksCanBeRebuiltWithoutAScan) {
  SemanticOctree octree(kResolution_m, {}), wanted(kResolution_m, {});
  std::vector<std::uint32_t> blocks;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    octree.InsertScan(RandomScan(seed));
    if (seed == 1) blocks = octree.touched_blocks();
    if (seed != 1) wanted.InsertScan(RandomScan(seed));
  }
  EXPECT_NE(Occupancies(octree), Occupancies(wanted));
  octree.BeginRebuild(blocks);
  for (const std::uint64_t seed : {0, 2, 3, 4}) octree.InsertScan(RandomScan(seed));
  octree.EndRebuild();
  EXPECT_EQ(Occupancies(octree), Occupancies(wanted));
  octree.InsertScan(RandomScan(9));
  wanted.InsertScan(RandomScan(9));
  EXPECT_EQ(Occupancies(octree), Occupancies(wanted));
}

TEST(SemanticOctree, OnlyTheBlocksNamedAreRebuilt) {
  SemanticOctree octree(kResolution_m, {});
  octree.InsertScan(RandomScan(0));
  octree.BeginRebuild(octree.FindBlocks(ScanTo(kEnd)));
  EXPECT_FALSE(octree.Find(kEnd));
  const Eigen::Vector3f far(3.05f, .05f, .05f);
  octree.InsertScan(ScanTo(far));
  octree.EndRebuild();
  EXPECT_TRUE(octree.Find(kEnd)) << "it lies on the way";
  EXPECT_FALSE(octree.IsOccupied(far));
}

TEST(SemanticOctree, FindingBlocksChangesNothing) {
  SemanticOctree octree(kResolution_m, AsOctoMap());
  const std::vector<std::uint32_t> blocks = octree.FindBlocks(ScanTo(kEnd));
  EXPECT_EQ(blocks.size(), 2u);  // of 0.8 m
  EXPECT_TRUE(octree.empty());
  octree.InsertScan(ScanTo(kEnd));
  std::vector<std::uint32_t> touched = octree.touched_blocks();
  std::sort(touched.begin(), touched.end());
  EXPECT_EQ(touched, (std::vector<std::uint32_t>{0, 1}));
  octree.BeginRebuild(blocks);
  octree.EndRebuild();
  EXPECT_TRUE(octree.empty());
}

TEST(SemanticOctree, MemoryGrowsWithTheMap) {
  SemanticOctree octree(kResolution_m, {});
  const std::size_t before = octree.MemoryBytes();
  octree.InsertScan(RandomScan(1));
  EXPECT_GT(octree.MemoryBytes(), before + 100000);
}

TEST(SemanticOctree, AResolutionOfNothingIsAnError) {
  EXPECT_THROW(SemanticOctree(0, {}), Error);
  EXPECT_THROW(SemanticOctree(10, {}), Error);
}

}  // namespace
}  // namespace ofm
