#include "ofm/loop/loop_correction.h"

#include <gtest/gtest.h>

#include "ofm/loop/test_ring.h"

namespace ofm {
namespace {

constexpr int kRound = 24;

/// A round that ends where it began, verified.
struct Round {
  explicit Round(const test::RingOptions& ring = {}) : made(ring) {
    made.AddUpTo(kRound + 1);
    RandomEngine engine = MakeRandomEngine(1, 0);
    loop = *VerifyLoop(*made.map.Snapshot(), KeyframeId(kRound), KeyframeId(0), made.world.model(),
                       options, engine)
                .loop;
  }
  MapCorrection Correct(const std::vector<ClosedLoop>& earlier = {}) {
    return *ComputeLoopCorrection(*made.map.Snapshot(), loop, earlier, made.world.model(), options);
  }
  test::RingMap made;
  LoopOptions options;
  VerifiedLoop loop;
};

TEST(LoopCorrection, DriftBeforeNoneAfter) {
  Round round({.drift_m = 0.001, .drift_rad = 0.0005, .bias_rad = 0.01});
  const KeyframeId last(kRound);
  const double before_m = round.made.Error_m(last), rms_before_m = round.made.RmsError_m();
  ASSERT_GT(before_m, 0.1);
  ApplyCorrection(round.Correct(), round.made.map);
  EXPECT_LT(round.made.Error_m(last), 0.01) << "before " << before_m;
  EXPECT_LT(round.made.RmsError_m(), 0.2 * rms_before_m) << "before " << rms_before_m;
  EXPECT_EQ(test::FindProblem(round.made.map), "");
}

TEST(LoopCorrection, BringsTheEndBackWhateverTheWayErred) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Round round({.seed = seed});
    ASSERT_GT(round.made.Error_m(KeyframeId(kRound)), 0.03) << seed;
    ApplyCorrection(round.Correct(), round.made.map);
    EXPECT_LT(round.made.Error_m(KeyframeId(kRound)), 0.01) << seed;
  }
}

TEST(LoopCorrection, TheFirstKeyframeStays) {
  Round round;
  const MapCorrection correction = round.Correct();
  const MapCorrection::KeyframeMove& first = correction.keyframes.at(KeyframeId(0));
  EXPECT_EQ(first.before.translation(), first.after.translation());
  EXPECT_EQ(correction.keyframes.size(), kRound + 1U) << "all keyframes are named";
}

TEST(LoopCorrection, AnotherSubmapIsNamedButStaysWhereItIs) {
  Round round;
  Keyframe apart = round.made.map.GetKeyframe(KeyframeId(3));
  apart.submap = SubmapId();
  apart.landmarks.assign(apart.landmarks.size(), LandmarkId());
  const KeyframeId id = round.made.map.AddKeyframe(apart);
  const MapCorrection correction = round.Correct();
  EXPECT_EQ(correction.keyframes.size(), kRound + 2U);
  EXPECT_TRUE(test::IsSame(correction.keyframes.at(id).after, apart.camera_from_world));
  EXPECT_FALSE(correction.join);
}

TEST(LoopCorrection, DuplicatesBecomeOneLandmark) {
  Round round;
  const std::size_t before = round.made.map.landmarks().size();
  const CorrectionReport report = ApplyCorrection(round.Correct(), round.made.map);
  EXPECT_GE(report.landmarks_fused, 100);
  EXPECT_EQ(round.made.map.landmarks().size(), before - report.landmarks_fused);
  // The two ends of the way now see the same.
  const Keyframe& last = round.made.map.GetKeyframe(KeyframeId(kRound));
  int shared = 0;
  for (const LandmarkId id : last.landmarks) {
    shared += id.valid() && round.made.map.GetLandmark(id).FeatureIn(KeyframeId(0)) >= 0;
  }
  EXPECT_GE(shared, 100);
}

TEST(LoopCorrection, NeighboursSeeTheDuplicatesToo) {
  Round round;
  ApplyCorrection(round.Correct(), round.made.map);
  const Keyframe& neighbour = round.made.map.GetKeyframe(KeyframeId(kRound - 1));
  int shared = 0;
  for (const LandmarkId id : neighbour.landmarks) {
    shared += id.valid() && round.made.map.GetLandmark(id).FeatureIn(KeyframeId(0)) >= 0;
  }
  EXPECT_GE(shared, 30);
}

TEST(LoopCorrection, KeyframesAddedMeanwhileComeAlong) {
  Round round;
  const MapCorrection correction = round.Correct();
  round.made.AddUpTo(kRound + 4);
  const KeyframeId added(kRound + 3);
  const double before = round.made.Error_m(added);
  const RigidTransform step_before =
      round.made.map.GetKeyframe(added).camera_from_world *
      round.made.map.GetKeyframe(KeyframeId(kRound)).camera_from_world.Inverse();
  ApplyCorrection(correction, round.made.map);
  const RigidTransform step_after =
      round.made.map.GetKeyframe(added).camera_from_world *
      round.made.map.GetKeyframe(KeyframeId(kRound)).camera_from_world.Inverse();
  EXPECT_LT(round.made.Error_m(added), 0.6 * before);
  EXPECT_LT(test::MaxDifference(step_before, step_after), 0.01);
  EXPECT_EQ(test::FindProblem(round.made.map), "");
}

TEST(LoopCorrection, WhatMovesIsNotFused) {
  Round round;
  Map& map = round.made.map;
  std::vector<LandmarkId> moving;
  for (const LandmarkId id : map.GetKeyframe(KeyframeId(0)).landmarks) {
    if (moving.size() < 30 && id.valid()) moving.push_back(id);
  }
  for (const LandmarkId id : moving) {
    for (int i = 0; i < 12; ++i) map.UpdateStaticProbability(id, 0);
  }
  RandomEngine engine = MakeRandomEngine(1, 0);
  round.loop = *VerifyLoop(*map.Snapshot(), KeyframeId(kRound), KeyframeId(0),
                           round.made.world.model(), round.options, engine)
                    .loop;
  ApplyCorrection(round.Correct(), map);
  for (const LandmarkId id : moving) {
    EXPECT_LT(map.GetLandmark(id).FeatureIn(KeyframeId(kRound)), 0);
  }
}

TEST(LoopCorrection, EarlierLoopsHold) {
  Round round;
  ApplyCorrection(round.Correct(), round.made.map);
  // As if the loop were found again, wrong by a metre: what was closed before holds against it.
  VerifiedLoop wrong = round.loop;
  wrong.place = KeyframeId(5);
  wrong.place_from_keyframe = test::CameraAt(1, 0, 0) * round.made.world.Truth(5) *
                              round.made.world.Truth(kRound).Inverse();
  wrong.camera_from_world = wrong.place_from_keyframe.Inverse() *
                            round.made.map.GetKeyframe(KeyframeId(5)).camera_from_world;
  const auto end_error = [&](const std::vector<ClosedLoop>& earlier) {
    const auto correction = ComputeLoopCorrection(*round.made.map.Snapshot(), wrong, earlier,
                                                  round.made.world.model(), round.options);
    const auto& move = correction->keyframes.at(KeyframeId(kRound)).after;
    return test::MaxDifference(move, round.made.world.Truth(kRound));
  };
  EXPECT_LT(end_error({{KeyframeId(kRound), KeyframeId(0)}}), 0.9 * end_error({}));
}

}  // namespace
}  // namespace ofm
