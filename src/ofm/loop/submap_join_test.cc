#include "ofm/loop/submap_join.h"

#include <gtest/gtest.h>

#include "ofm/loop/test_ring.h"

namespace ofm {
namespace {

/// Keyframes 0 to 7 of a round are a sub-map in the true world, and 8 to 15 are another one, in any
/// world, that begins at view 4: both show views 4 to 7.
struct TwoSubmaps {
  TwoSubmaps() : made({.drift_m = 0, .drift_rad = 0}) {
    for (int i = 0; i < 8; ++i) made.Add(i);
    made.BeginSubmap({ExpSo3({0.3, 2, -0.5}), {4, -7, 2}});
    for (int i = 4; i < 12; ++i) made.Add(i);
  }
  VerifiedLoop Verify(std::uint32_t keyframe, std::uint32_t place) {
    RandomEngine engine = MakeRandomEngine(1, 0);
    return *VerifyLoop(*made.map.Snapshot(), KeyframeId(keyframe), KeyframeId(place),
                       made.world.model(), options, engine)
                .loop;
  }
  CorrectionReport Join(const VerifiedLoop& loop, const SubmapJoin& join) {
    return ApplyCorrection(
        ComputeSubmapJoin(*made.map.Snapshot(), loop, join, made.world.model(), options), made.map);
  }
  RigidTransform Pose(std::uint32_t id) const {
    return made.map.GetKeyframe(KeyframeId(id)).camera_from_world;
  }

  test::RingMap made;
  LoopOptions options;
};

constexpr SubmapId kOlder(0), kNewer(8);

TEST(SubmapJoin, BringsTheNewerOneToWhereItTrulyIs) {
  TwoSubmaps two;
  const std::size_t landmarks = two.made.map.landmarks().size();
  ASSERT_EQ(two.made.map.FindSubmap(KeyframeId(15)), kNewer);
  ASSERT_GT(two.made.Error_m(KeyframeId(15)), 1);
  const CorrectionReport report = two.Join(two.Verify(10, 6), {kNewer, kOlder});
  for (std::uint32_t i = 0; i < 16; ++i) {
    EXPECT_LT(two.made.Error_m(KeyframeId(i)), 0.01) << i;
    EXPECT_EQ(two.made.map.FindSubmap(KeyframeId(i)), kOlder);
  }
  EXPECT_GE(report.landmarks_fused, 100);
  EXPECT_EQ(two.made.map.landmarks().size(), landmarks - report.landmarks_fused);
  EXPECT_EQ(test::FindProblem(two.made.map), "");
}

TEST(SubmapJoin, MovesRigidlyAndLeavesTheOtherToTheBit) {
  TwoSubmaps two;
  const auto before = two.made.map.Snapshot();
  two.Join(two.Verify(10, 6), {kNewer, kOlder});
  for (std::uint32_t i = 0; i < 8; ++i) {
    EXPECT_TRUE(
        test::IsSame(two.Pose(i), before->keyframes.Find(KeyframeId(i))->camera_from_world));
  }
  for (std::uint32_t i = 9; i < 16; ++i) {
    const RigidTransform step = *before->FindKeyframePose(KeyframeId(i)) *
                                before->FindKeyframePose(KeyframeId(8))->Inverse();
    EXPECT_LT(test::MaxDifference(two.Pose(i) * two.Pose(8).Inverse(), step), 1e-9);
  }
}

TEST(SubmapJoin, ACameraBackInTheOlderOneMovesTheNewerOneToo) {
  TwoSubmaps two;
  two.Join(two.Verify(6, 10), {kNewer, kOlder});
  for (std::uint32_t i = 0; i < 16; ++i) {
    EXPECT_LT(two.made.Error_m(KeyframeId(i)), 0.01) << i;
    EXPECT_EQ(two.made.map.FindSubmap(KeyframeId(i)), kOlder);
  }
  EXPECT_EQ(test::FindProblem(two.made.map), "");
}

TEST(SubmapJoin, TheOlderOneMovesWhereTheNewerKeepsItsWorld) {
  TwoSubmaps two;
  const RigidTransform newest = two.Pose(15);
  two.Join(two.Verify(10, 6), {kOlder, kNewer});
  EXPECT_TRUE(test::IsSame(two.Pose(15), newest));
  EXPECT_EQ(two.made.map.FindSubmap(KeyframeId(0)), kNewer);
  const RigidTransform truth = two.made.world.Truth(0) * two.made.world.Truth(11).Inverse();
  EXPECT_LT(test::MaxDifference(two.Pose(0) * two.Pose(15).Inverse(), truth), 0.01);
}

}  // namespace
}  // namespace ofm
