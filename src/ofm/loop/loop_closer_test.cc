#include "ofm/loop/loop_closer.h"

#include <gtest/gtest.h>

#include "ofm/loop/test_ring.h"

namespace ofm {
namespace {

constexpr int kRound = 24;

/// A way round with the stage at work, the corrections applied.
struct ClosingRun {
  explicit ClosingRun(const test::RingOptions& ring = {}, const LoopOptions& options = {},
                      std::uint64_t seed = 1, SubmapId fixed_world = {})
      : made(ring), closer(made.world.model(), options, seed, fixed_world) {}

  /// On to keyframe `end`, or the first loop.
  void Run(int end) {
    for (int i = static_cast<int>(made.map.keyframes().size()); i < end; ++i) {
      made.AddUpTo(i + 1);
      if (Look(KeyframeId(i))) break;
    }
  }
  /// Keyframes of views [first, end), or up to the first loop.
  void RunViews(int first, int end) {
    for (int i = first; i < end && !Look(made.Add(i)); ++i) {
    }
  }
  bool Look(KeyframeId id) {
    error_before = made.Error_m(id);
    const auto closure = closer.Process(*made.map.Snapshot(), id);
    if (!closure) return false;
    loops.push_back(closure->loop);
    if (closure->correction.join) joins.push_back(*closure->correction.join);
    fused += ApplyCorrection(closure->correction, made.map).landmarks_fused;
    error_after = made.Error_m(id);
    return true;
  }
  test::RingMap made;
  LoopCloser closer;
  std::vector<VerifiedLoop> loops;
  std::vector<SubmapJoin> joins;
  int fused = 0;
  double error_before = 0, error_after = 0;
};

TEST(LoopCloser, ClosesTheLoopOfARoundRoom) {
  ClosingRun run;
  run.Run(kRound + 6);
  ASSERT_EQ(run.loops.size(), 1U);
  EXPECT_EQ(run.closer.counts().closed, 1U);
  const VerifiedLoop& loop = run.loops.front();
  EXPECT_GE(loop.keyframe.value, kRound - 4U);
  EXPECT_LE(loop.place.value, 6U);
  const RigidTransform truth =
      run.made.world.Truth(static_cast<int>(loop.place.value)) *
      run.made.world.Truth(static_cast<int>(loop.keyframe.value)).Inverse();
  EXPECT_LT(test::MaxDifference(loop.place_from_keyframe, truth), 0.02);
  EXPECT_GT(run.fused, 50);
  EXPECT_LT(run.error_after, 0.5 * run.error_before);
}

TEST(LoopCloser, FindsNoneBeforeTheCameraIsBack) {
  ClosingRun run;
  run.Run(kRound - 6);
  EXPECT_TRUE(run.loops.empty());
  EXPECT_EQ(run.closer.counts().keyframes, kRound - 6U);
  EXPECT_EQ(run.closer.counts().no_alignment + run.closer.counts().few_inliers, 0U);
}

TEST(LoopCloser, WhatLooksAlikeButStandsOtherwiseIsNoLoop) {
  ClosingRun run;
  run.Run(kRound - 6);
  RandomEngine engine = MakeRandomEngine(2, 0);
  for (std::uint32_t i = 0; i < 10; ++i) {
    const std::vector<LandmarkId> landmarks = run.made.map.GetKeyframe(KeyframeId(i)).landmarks;
    for (const LandmarkId id : landmarks) {
      const double x = UniformReal(engine), y = UniformReal(engine), z = UniformReal(engine);
      run.made.map.SetLandmarkPosition(id, {4 * x - 2, 2 * y - 1, 4 * z - 2});
    }
  }
  run.Run(kRound + 4);
  EXPECT_TRUE(run.loops.empty());
  EXPECT_GE(run.closer.counts().no_alignment, 1U);
}

TEST(LoopCloser, TheSameSeedGivesTheSameBits) {
  ClosingRun a, b;
  a.Run(kRound + 6);
  b.Run(kRound + 6);
  ASSERT_EQ(a.loops.size(), 1U);
  ASSERT_EQ(b.loops.size(), 1U);
  a.made.map.keyframes().ForEach([&](const Keyframe& k) {
    const RigidTransform& other = b.made.map.GetKeyframe(k.id).camera_from_world;
    EXPECT_EQ(k.camera_from_world.translation(), other.translation());
    EXPECT_EQ(k.camera_from_world.rotation().coeffs(), other.rotation().coeffs());
  });
}

TEST(LoopCloser, PausesAfterALoop) {
  ClosingRun run({}, {.pause_keyframes = 3});
  run.Run(kRound + 6);
  ASSERT_EQ(run.loops.size(), 1U);
  const std::size_t looked = run.closer.counts().keyframes;
  int next = static_cast<int>(run.loops.front().keyframe.value) + 1;
  for (int i = 0; i < 4; ++i) {
    run.made.AddUpTo(++next);
    run.closer.Process(*run.made.map.Snapshot(), KeyframeId(next - 1));
  }
  EXPECT_EQ(run.closer.counts().keyframes, looked + 1);
}

TEST(LoopCloser, KeyframesOfALoadedMapArePlacesToo) {
  ClosingRun run;
  run.made.AddUpTo(kRound - 8);
  run.Run(kRound + 6);
  EXPECT_EQ(run.loops.size(), 1U);
}

/// Sub-map 0 is views 0 to 9, sub-map 10 views 14 and on: until the camera is back at view 0 = 24.
ClosingRun LostRun(SubmapId fixed_world = {}) {
  ClosingRun run({.drift_m = 0.002, .drift_rad = 0.001}, {}, 1, fixed_world);
  run.RunViews(0, 10);
  run.made.BeginSubmap({ExpSo3({1, 0, 2}), {3, 4, 5}});
  run.RunViews(14, kRound + 8);
  return run;
}

TEST(LoopCloser, APlaceOfAnotherSubmapJoinsTheTwo) {
  const ClosingRun run = LostRun();
  ASSERT_EQ(run.joins.size(), 1U);
  EXPECT_EQ(run.joins.front().from, SubmapId(10));
  EXPECT_EQ(run.joins.front().into, SubmapId(0));
  EXPECT_EQ(run.closer.counts().joined, 1U);
  EXPECT_EQ(run.closer.counts().closed, 0U);
  EXPECT_GT(run.fused, 50);
  const KeyframeId last = run.loops.front().keyframe;
  EXPECT_LT(run.error_after, 0.05);
  EXPECT_EQ(run.made.map.FindSubmap(last), SubmapId(0));
  EXPECT_EQ(test::FindProblem(run.made.map), "");
}

TEST(LoopCloser, TheFixedWorldStaysWhateverItsAge) {
  const ClosingRun run = LostRun(SubmapId(10));
  ASSERT_EQ(run.joins.size(), 1U);
  EXPECT_EQ(run.joins.front().from, SubmapId(0));
  EXPECT_EQ(run.joins.front().into, SubmapId(10));
}

TEST(LoopCloser, AKeyframeThatIsGoneIsNoError) {
  ClosingRun run;
  EXPECT_FALSE(run.closer.Process(*run.made.map.Snapshot(), KeyframeId(3)));
}

}  // namespace
}  // namespace ofm
