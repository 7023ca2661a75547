#include "ofm/loop/loop_verifier.h"

#include <gtest/gtest.h>

#include "ofm/loop/test_ring.h"

namespace ofm {
namespace {

using test::RingMap;

constexpr int kRound = 24;

/// A map of one round and the keyframe that is at the first one's place again.
struct Round {
  Round() { made.AddUpTo(kRound + 1); }
  LoopVerification Verify(KeyframeId keyframe, KeyframeId place, const LoopOptions& options = {}) {
    RandomEngine engine = MakeRandomEngine(1, 0);
    return VerifyLoop(*made.map.Snapshot(), keyframe, place, made.world.model(), options, engine);
  }
  RingMap made;
  KeyframeId first{0}, last{kRound};
};

/// Gives every landmark of the map to `change(LandmarkId)`.
template <class Change>
void ForEachLandmarkOf(Map& map, KeyframeId keyframe, Change&& change) {
  const std::vector<LandmarkId> landmarks = map.GetKeyframe(keyframe).landmarks;
  for (const LandmarkId id : landmarks) change(id);
}

TEST(LoopVerifier, FindsTheCameraThatCameBack) {
  Round round;
  ASSERT_GT(round.made.Error_m(round.last), 0.02) << "drift";
  const LoopVerification verification = round.Verify(round.last, round.first);
  ASSERT_EQ(verification.verdict, LoopVerdict::kVerified);
  const VerifiedLoop& loop = *verification.loop;
  EXPECT_EQ(loop.keyframe, round.last);
  EXPECT_EQ(loop.place, round.first);
  EXPECT_GE(loop.matches.size(), 100U);
  // After one round the camera is where it began.
  EXPECT_LT(test::MaxDifference(loop.place_from_keyframe, RigidTransform()), 0.01);
  EXPECT_LT(test::MaxDifference(loop.camera_from_world, round.made.world.Truth(0)), 0.01);
}

TEST(LoopVerifier, FindsACameraBesideThePlace) {
  Round round;
  const LoopVerification verification = round.Verify(round.last, KeyframeId(1));
  ASSERT_EQ(verification.verdict, LoopVerdict::kVerified);
  const RigidTransform truth = round.made.world.Truth(1) * round.made.world.Truth(kRound).Inverse();
  EXPECT_LT(test::MaxDifference(verification.loop->place_from_keyframe, truth), 0.015);
}

TEST(LoopVerifier, AnotherPlaceHasFewMatches) {
  Round round;
  EXPECT_EQ(round.Verify(round.last, KeyframeId(12)).verdict, LoopVerdict::kFewMatches);
}

TEST(LoopVerifier, ThingsThatLookAlikeButStandOtherwiseAreNoLoop) {
  Round round;
  RandomEngine engine = MakeRandomEngine(2, 0);
  // The same things about the first keyframe, in other places before it.
  for (const std::uint32_t keyframe : {0, 1, 2, 3, 4, 5}) {
    ForEachLandmarkOf(round.made.map, KeyframeId(keyframe), [&](LandmarkId id) {
      const double x = UniformReal(engine), y = UniformReal(engine), z = UniformReal(engine);
      round.made.map.SetLandmarkPosition(id, {3 * x - 1.5, 2 * y - 1, 2 + 2 * z});
    });
  }
  EXPECT_EQ(round.Verify(round.last, round.first).verdict, LoopVerdict::kNoAlignment);
}

TEST(LoopVerifier, WhatMovesTakesNoPart) {
  Round round;
  ForEachLandmarkOf(round.made.map, round.first, [&](LandmarkId id) {
    for (int i = 0; i < 12; ++i) round.made.map.UpdateStaticProbability(id, 0);
  });
  EXPECT_EQ(round.Verify(round.last, round.first).verdict, LoopVerdict::kFewMatches);
  EXPECT_EQ(round.Verify(round.last, round.first, {.min_static_probability = 0}).verdict,
            LoopVerdict::kVerified);
}

TEST(LoopVerifier, WhatBothSeeAnywayProvesNothing) {
  Round round;
  const LoopVerification before = round.Verify(round.last, round.first);
  const Keyframe last = round.made.map.GetKeyframe(round.last);
  for (int i = 0; i < 10; ++i) {
    const LoopMatch& match = before.loop->matches[i];
    round.made.map.Fuse(last.landmarks[match.feature], match.landmark);
  }
  const LoopVerification after = round.Verify(round.last, round.first);
  EXPECT_LE(after.loop->matches.size(), before.loop->matches.size() - 10);
}

TEST(LoopVerifier, FewerInliersThanAskedForAreNoLoop) {
  Round round;
  EXPECT_EQ(round.Verify(round.last, round.first, {.min_inliers = 1000}).verdict,
            LoopVerdict::kFewInliers);
}

}  // namespace
}  // namespace ofm
