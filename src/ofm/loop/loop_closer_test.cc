#include "ofm/loop/loop_closer.h"

#include <gtest/gtest.h>

#include "ofm/features/default_vocabulary.h"
#include "ofm/loop/test_ring.h"

namespace ofm {
namespace {

constexpr int kRound = 24;

/// A way round with the stage at work, the corrections applied.
struct ClosingRun {
  explicit ClosingRun(const test::RingOptions& ring = {}, const LoopOptions& options = {},
                      std::uint64_t seed = 1)
      : made(ring), closer(made.world.model(), options, DefaultVocabulary(), seed) {}

  /// On to keyframe `end`, or the first loop.
  void Run(int end) {
    for (int i = static_cast<int>(made.map.keyframes().size()); i < end; ++i) {
      made.AddUpTo(i + 1);
      error_before = made.Error_m(KeyframeId(i));
      const auto closure = closer.Process(*made.map.Snapshot(), KeyframeId(i));
      if (!closure) continue;
      loops.push_back(closure->loop);
      fused += ApplyCorrection(closure->correction, made.map).landmarks_fused;
      error_after = made.Error_m(KeyframeId(i));
      break;
    }
  }
  test::RingMap made;
  LoopCloser closer;
  std::vector<VerifiedLoop> loops;
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

TEST(LoopCloser, AKeyframeThatIsGoneIsNoError) {
  ClosingRun run;
  EXPECT_FALSE(run.closer.Process(*run.made.map.Snapshot(), KeyframeId(3)));
}

}  // namespace
}  // namespace ofm
