// Loops in the back end: keyframes of a round room, as tracking would hand them over.
#include <gtest/gtest.h>

#include "ofm/loop/test_ring.h"
#include "ofm/map/submap.h"
#include "ofm/perception/null_segmenter.h"
#include "ofm/pipeline/back_end.h"

namespace ofm {
namespace {

constexpr int kRound = 24;

SlamOptions RingSlamOptions() {
  SlamOptions options;
  options.build_semantic_map = false;
  options.final_adjustment = false;
  return options;
}

/// A back end that is fed a way round. Tracking errs, and knows nothing of what was out of sight.
class RingRun {
 public:
  explicit RingRun(LoopAdjustment adjustment, const SlamOptions& options = RingSlamOptions())
      : slam_(world_.model().camera, options, std::make_unique<NullSegmenter>()),
        back_end_(slam_, adjustment) {}

  void Run(int keyframes) {
    while (next_ < keyframes) Step(next_++);
  }
  /// The camera is lost: `views` of the round go by, and the next one begins a sub-map.
  void Lose(int views) {
    next_ += views;
    is_lost_ = true;
  }
  RunOutcome Finish() {
    RunOutcome outcome;
    back_end_.Finish(outcome);
    return outcome;
  }
  const Map& map() { return slam_.mapper().map(); }
  /// Distance of a keyframe from where it should be [m].
  double Error_m(KeyframeId id) {
    const Keyframe& keyframe = map().GetKeyframe(id);
    const auto i = static_cast<int>(keyframe.stamp_ns);
    const RigidTransform truth = world_.Truth(i) * world_.Truth(0).Inverse();
    return (keyframe.CenterInWorld() - truth.Inverse().translation()).norm();
  }

 private:
  void Step(int i) {
    const test::RingWorld::View view = world_.Look(i);
    KeyframeJob job;
    job.candidate.frame_id = FrameId(i);
    job.candidate.stamp_ns = i;
    job.candidate.features = view.features;
    job.candidate.landmarks.resize(view.shown.size());
    job.candidate.begins_submap = is_lost_;
    if (is_lost_) {
      if (i > 0) job.candidate.camera_from_world = {ExpSo3({0.5, 1, 2}), {-2, 3, 1}};
    } else {
      job.candidate.reference = map().latest_keyframe();
      job.candidate.camera_from_reference =
          world_.DriftOf(i) * world_.Truth(i) * world_.Truth(i - 1).Inverse();
      for (std::size_t f = 0; f < view.shown.size(); ++f) {
        const auto name = name_of_.find(view.shown[f]);
        if (name != name_of_.end()) job.candidate.landmarks[f] = name->second;
      }
    }
    is_lost_ = false;
    const auto inserted = back_end_.Insert(std::move(job));
    name_of_.clear();
    const Keyframe& keyframe = *inserted->keyframes.Find(inserted->latest_keyframe);
    for (std::size_t f = 0; f < view.shown.size(); ++f) {
      if (keyframe.landmarks[f].valid()) name_of_[view.shown[f]] = keyframe.landmarks[f];
    }
    back_end_.Refine();
  }

  test::RingWorld world_{{.landmarks = 700, .pixel_sigma = 0.3}};
  Slam slam_;
  BackEnd back_end_;
  int next_ = 0;
  bool is_lost_ = true;
  std::map<int, LandmarkId> name_of_;
};

class BackEndLoop : public testing::TestWithParam<LoopAdjustment> {};

TEST_P(BackEndLoop, JoinsSubmapsByAPlaceOfBoth) {
  RingRun run(GetParam());
  run.Run(8);
  run.Lose(4);
  run.Run(kRound - 3);
  EXPECT_GT(run.Error_m(run.map().latest_keyframe()), 1);
  EXPECT_EQ(run.Finish().loop_counts.joined, 0U);
  run.Run(kRound + 6);
  const RunOutcome outcome = run.Finish();
  EXPECT_EQ(outcome.loop_counts.joined, 1U);
  EXPECT_EQ(outcome.loop_counts.closed, 0U);
  ASSERT_EQ(outcome.loops.size(), 1U);
  ASSERT_TRUE(outcome.loops.front().join);
  EXPECT_EQ(outcome.loops.front().join->into, SubmapId(0));
  EXPECT_EQ(outcome.loops.front().drift_m, 0);
  EXPECT_GE(outcome.loops.front().landmarks_fused, 20);
  EXPECT_LT(run.Error_m(outcome.map->latest_keyframe), 0.02);
  EXPECT_EQ(FindSubmaps(*outcome.map).size(), 1U);
  EXPECT_EQ(test::FindProblem(run.map()), "");
}

TEST_P(BackEndLoop, ClosesTheRoundAndTellsOfIt) {
  RingRun run(GetParam());
  run.Run(kRound + 4);
  const RunOutcome outcome = run.Finish();
  EXPECT_EQ(outcome.loop_counts.closed, 1U);
  ASSERT_EQ(outcome.loops.size(), 1U);
  const LoopRecord& loop = outcome.loops.front();
  EXPECT_GE(loop.keyframe_stamp_ns, kRound - 5);
  EXPECT_LE(loop.place_stamp_ns, 6);
  EXPECT_GE(loop.matches, 40U);
  EXPECT_GE(loop.landmarks_fused, 20);
  EXPECT_LT(run.Error_m(outcome.map->latest_keyframe), 0.02);
  EXPECT_EQ(test::FindProblem(run.map()), "");
}

INSTANTIATE_TEST_SUITE_P(All, BackEndLoop,
                         testing::Values(LoopAdjustment::kAtOnce, LoopAdjustment::kInBackground));

TEST(BackEndLoops, AreNotLookedForWhereTheyAreSwitchedOff) {
  SlamOptions options = RingSlamOptions();
  options.loop.enabled = false;
  RingRun run(LoopAdjustment::kAtOnce, options);
  run.Run(6);
  const RunOutcome outcome = run.Finish();
  EXPECT_EQ(outcome.loop_counts.keyframes, 0U);
  EXPECT_TRUE(outcome.loops.empty());
}

TEST(BackEndLoops, AFinalAdjustmentNeedsNoneInTheBackground) {
  SlamOptions options = RingSlamOptions();
  options.final_adjustment = true;
  RingRun run(LoopAdjustment::kInBackground, options);
  run.Run(kRound + 4);
  const RunOutcome outcome = run.Finish();
  EXPECT_EQ(outcome.loop_counts.closed, 1U);
  EXPECT_LT(run.Error_m(outcome.map->latest_keyframe), 0.02);
}

}  // namespace
}  // namespace ofm
