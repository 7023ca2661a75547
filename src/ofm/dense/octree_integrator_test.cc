#include "ofm/dense/octree_integrator.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "ofm/dense/octree_file.h"
#include "ofm/dense/test_scene.h"

namespace ofm {
namespace {

using test::At, test::Chair, test::SmallCamera, test::Wall;

/// Key frames along the wall; every second one looks back, away from the others.
KeyframePoseMap MakePoses(std::uint32_t count) {
  KeyframePoseMap poses;
  for (std::uint32_t i = 0; i < count; ++i) {
    poses[KeyframeId(i)] =
        i % 2 == 0 ? At(.1 * i, 0, .1) : RigidTransform(ExpSo3({0, M_PI, 0}), {.05 * i, 0, -.5});
  }
  return poses;
}

KeyframeClouds MakeClouds(std::uint32_t count) {
  const std::vector<test::Box> boxes{
      Wall(), Chair(), {{-4, -4, -3.5}, {4, 4, -3.02}, test::kRed, 3, false}};
  const KeyframeCloudMaker maker(SmallCamera(), {});
  KeyframeClouds clouds;
  for (const auto& [id, pose] : MakePoses(count)) {
    clouds[id] =
        std::make_shared<const KeyframeCloud>(maker.Make(Render(SmallCamera(), boxes, pose, id)));
  }
  return clouds;
}

/// The files that the octree becomes.
std::string Bytes(const SemanticOctree& octree) {
  std::ostringstream stream;
  WriteColorOcTree(stream, octree);
  WriteBinaryOcTree(stream, octree);
  WriteVoxelLabels(stream, octree, {});
  return stream.str();
}

std::string BuiltAtOnce(const KeyframeClouds& clouds, const KeyframePoseMap& poses) {
  OctreeIntegrator integrator{DenseOptions()};
  integrator.Update(clouds, poses, 0);
  return Bytes(integrator.octree());
}

class OctreeIntegratorTest : public testing::Test {
 protected:
  static constexpr std::uint32_t kCount = 10;
  static constexpr double kHalfVoxel_m = .025;

  IntegrationCounts Update(double tolerance_m = kHalfVoxel_m) {
    return integrator_.Update(clouds_, poses_, tolerance_m);
  }
  void Move(std::uint32_t id, const RigidTransform& motion) {
    poses_[KeyframeId(id)] = motion * poses_[KeyframeId(id)];
  }
  void ExpectAsBuiltAtOnce() {
    EXPECT_EQ(Bytes(integrator_.octree()), BuiltAtOnce(clouds_, poses_));
  }

  KeyframeClouds clouds_ = MakeClouds(kCount);
  KeyframePoseMap poses_ = MakePoses(kCount);
  OctreeIntegrator integrator_{DenseOptions()};
};

TEST_F(OctreeIntegratorTest, KeyframesThatComeOneByOneGiveTheMapOfAll) {
  const KeyframePoseMap all = poses_;
  poses_.clear();
  for (const auto& [id, pose] : all) {
    poses_[id] = pose;
    const IntegrationCounts counts = Update();
    EXPECT_EQ(counts.added, 1u);
    EXPECT_EQ(counts.moved + counts.removed + counts.reintegrated, 0u);
  }
  ExpectAsBuiltAtOnce();
  EXPECT_EQ(Update().added, 0u);
}

TEST_F(OctreeIntegratorTest, AKeyframeThatMovesTakesWhatItTouchedAlong) {
  Update();
  Move(4, At(.2, .05, 0));
  const IntegrationCounts counts = Update();
  EXPECT_EQ(counts.moved, 1u);
  EXPECT_GE(counts.reintegrated, 3u);
  EXPECT_LT(counts.reintegrated, kCount - 1) << "not all look there";
  ExpectAsBuiltAtOnce();
}

TEST_F(OctreeIntegratorTest, AfterALoopAllIsAsIfItHadAlwaysBeenSo) {
  Update();
  for (std::uint32_t i = 3; i < kCount; ++i) {
    Move(i, RigidTransform(ExpSo3({0, .01 * i, 0}), {0, .02 * i, 0}));
  }
  EXPECT_EQ(Update().moved, kCount - 3);
  ExpectAsBuiltAtOnce();
}

TEST_F(OctreeIntegratorTest, SmallMotionsWaitUntilTheEnd) {
  Update();
  const std::string before = Bytes(integrator_.octree());
  Move(4, At(.02, 0, 0));
  Move(6, RigidTransform(ExpSo3({0, .004, 0}), {0, 0, 0}));  // 2 cm at the range of 5 m
  EXPECT_EQ(Update().moved, 0u);
  EXPECT_EQ(Bytes(integrator_.octree()), before);
  EXPECT_EQ(Update(0).moved, 2u);
  ExpectAsBuiltAtOnce();
  Move(6, At(.026, 0, 0));
  EXPECT_EQ(Update().moved, 1u);
  ExpectAsBuiltAtOnce();
}

TEST_F(OctreeIntegratorTest, SmallMotionsAddUp) {
  Update();
  for (int i = 0; i < 3; ++i) {
    Move(4, At(.01, 0, 0));
    EXPECT_EQ(Update().moved, i == 2 ? 1u : 0u);
  }
  ExpectAsBuiltAtOnce();
}

TEST_F(OctreeIntegratorTest, KeyframesCanGoAndComeBack) {
  Update();
  const KeyframePoseMap all = poses_;
  poses_.erase(KeyframeId(2));
  poses_[KeyframeId(6)] = At(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  EXPECT_EQ(Update().removed, 2u);
  ExpectAsBuiltAtOnce();
  poses_ = all;
  EXPECT_EQ(Update().added, 2u) << "though their ids are not the last";
  ExpectAsBuiltAtOnce();
  poses_.clear();
  EXPECT_EQ(Update().removed, kCount);
  EXPECT_TRUE(integrator_.octree().empty());
  ExpectAsBuiltAtOnce();
}

TEST_F(OctreeIntegratorTest, ACloudThatIsReplacedCountsAsMoved) {
  Update();
  clouds_[KeyframeId(4)] = std::make_shared<const KeyframeCloud>();
  EXPECT_EQ(Update().moved, 1u);
  ExpectAsBuiltAtOnce();
  Move(4, At(1, 0, 0));  // it touches nothing
  EXPECT_EQ(Update().moved, 1u);
  ExpectAsBuiltAtOnce();
}

TEST_F(OctreeIntegratorTest, TakingTheOctreeBeginsAnew) {
  Update();
  const std::size_t bytes = integrator_.MemoryBytes();
  const SemanticOctree taken = integrator_.Take();
  EXPECT_EQ(Bytes(taken), BuiltAtOnce(clouds_, poses_));
  EXPECT_TRUE(integrator_.octree().empty());
  EXPECT_LT(integrator_.MemoryBytes(), bytes / 10);
  EXPECT_EQ(Update().added, kCount);
}

}  // namespace
}  // namespace ofm
