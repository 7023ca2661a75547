#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "ofm/eval/evaluation.h"
#include "ofm/pipeline/test_support.h"

namespace ofm {
namespace {

using test::MakeSlam;
using test::PlaySource;
using test::Recording;
using testing::Contains;
using testing::IsEmpty;
using testing::Key;

RunOutcome RunOnce(const Recording& recording, const SlamOptions& options = test::QuickOptions()) {
  PlaySource source(recording.images);
  return RunSequential(*MakeSlam(recording, options), source, {});
}

/// Above what these small images give, far below the path's extent.
constexpr double kMaxAte_m = 0.02, kMaxLiveAte_m = 0.03;

double Ate_m(const Trajectory& estimate, const Recording& recording) {
  return ComputeAte(estimate, recording.sequence.GroundTruth()).translation_m.rmse;
}

void ExpectSamePoses(const Trajectory& a, const Trajectory& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].stamp_ns, b[i].stamp_ns);
    EXPECT_EQ(a[i].world_from_camera.translation(), b[i].world_from_camera.translation()) << i;
    EXPECT_EQ(a[i].world_from_camera.rotation().coeffs(),
              b[i].world_from_camera.rotation().coeffs())
        << i;
  }
}

TEST(RunSequential, TracksEveryFrameAndMapsTheRoom) {
  const Recording recording(24);
  const RunOutcome outcome = RunOnce(recording);
  EXPECT_THAT(outcome.error, IsEmpty());
  EXPECT_EQ(outcome.counts.frames, 24U);
  EXPECT_EQ(outcome.counts.frames_tracked, 24U);
  EXPECT_EQ(outcome.counts.losses, 0U);
  EXPECT_EQ(outcome.counts.frames_dropped, 0U);
  EXPECT_EQ(outcome.trajectory.size(), 24U);
  EXPECT_EQ(outcome.live_trajectory.size(), 24U);
  EXPECT_LT(Ate_m(outcome.trajectory, recording), kMaxAte_m);
  EXPECT_LT(Ate_m(outcome.live_trajectory, recording), kMaxLiveAte_m);
  EXPECT_GE(outcome.counts.keyframes, 1U);
  EXPECT_EQ(outcome.keyframe_trajectory.size(), outcome.counts.keyframes);
  EXPECT_GE(outcome.counts.keyframes_made, outcome.counts.keyframes);
  EXPECT_GT(outcome.counts.landmarks, 100U);
  EXPECT_GT(outcome.counts.mean_masked_share, 0.01);
  EXPECT_LT(outcome.counts.mean_masked_share, 0.8);
  ASSERT_TRUE(outcome.semantic_map);
  EXPECT_GT(outcome.semantic_map->cloud_in_world.size(), 500U);
  EXPECT_THAT(outcome.class_names, testing::ElementsAre("person"));
}

TEST(RunSequential, TellsTheTimeOfEveryStage) {
  const Recording recording(6);
  const RunOutcome outcome = RunOnce(recording);
  for (const char* stage : {"segmentation", "dynamics", "features", "tracking"}) {
    ASSERT_THAT(outcome.times.stages(), Contains(Key(stage)));
    EXPECT_EQ(outcome.times.stages().at(stage).wall_ms.size(), 6U) << stage;
  }
  for (const char* stage : {"keyframe_insertion", "mapping", "final_adjustment", "semantic_map"}) {
    EXPECT_THAT(outcome.times.stages(), Contains(Key(stage)));
  }
  EXPECT_GT(outcome.wall_s, 0);
  EXPECT_GT(outcome.process_cpu_s, 0);
}

TEST(RunSequential, SameSeedGivesTheSamePosesToTheLastBit) {
  const Recording recording(16);
  const RunOutcome first = RunOnce(recording), second = RunOnce(recording);
  ASSERT_EQ(first.trajectory.size(), 16U);
  ExpectSamePoses(first.trajectory, second.trajectory);
  ExpectSamePoses(first.live_trajectory, second.live_trajectory);
  ExpectSamePoses(first.keyframe_trajectory, second.keyframe_trajectory);
  EXPECT_EQ(first.counts.landmarks, second.counts.landmarks);
}

TEST(RunSequential, AnyOtherSeedTracksAsWell) {
  const Recording recording(16);
  SlamOptions options = test::QuickOptions();
  for (const std::uint64_t seed : {7U, 8U}) {
    options.seed = seed;
    const RunOutcome outcome = RunOnce(recording, options);
    EXPECT_EQ(outcome.counts.frames_tracked, 16U) << seed;
    EXPECT_LT(Ate_m(outcome.trajectory, recording), kMaxAte_m) << seed;
  }
}

TEST(RunSequential, SystemsInOneProcessDoNotNoticeOneAnother) {
  const Recording recording(10), other(10, 2);
  const RunOutcome alone = RunOnce(recording);
  RunOutcome first, second;
  {
    std::jthread a([&] { first = RunOnce(recording); });
    std::jthread b([&] { second = RunOnce(other); });
  }
  ExpectSamePoses(first.trajectory, alone.trajectory);
  EXPECT_EQ(first.counts.landmarks, alone.counts.landmarks);
  EXPECT_LT(Ate_m(second.trajectory, other), kMaxAte_m);
}

TEST(RunSequential, TellsObserversOfEveryFrameInOrder) {
  const Recording recording(8);
  std::vector<std::size_t> done;
  std::vector<FrameId> ids;
  std::size_t landmarks = 0;
  test::CallingObserver observer([&](const FrameReport& report) {
    done.push_back(report.frames_done);
    ids.push_back(report.prepared.frame.id);
    landmarks = report.landmarks;
    EXPECT_TRUE(HasPose(report.tracking.status));
  });
  PlaySource source(recording.images);
  RunSequential(*MakeSlam(recording), source, {{&observer}, {}});
  EXPECT_THAT(done, testing::ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  for (std::uint32_t i = 0; i < 8; ++i) EXPECT_EQ(ids[i], FrameId(i));
  EXPECT_GT(landmarks, 100U);
}

TEST(RunSequential, StopsWhenAskedToAndKeepsTheResults) {
  const Recording recording(10);
  std::stop_source stop;
  test::CallingObserver observer([&](const FrameReport& report) {
    if (report.frames_done == 6) stop.request_stop();
  });
  PlaySource source(recording.images);
  const RunOutcome outcome =
      RunSequential(*MakeSlam(recording), source, {{&observer}, stop.get_token()});
  EXPECT_EQ(outcome.trajectory.size(), 6U);
  EXPECT_THAT(outcome.error, IsEmpty());
  EXPECT_TRUE(outcome.semantic_map);
}

TEST(RunSequential, KeepsWhatWasComputedBeforeTheSourceFailed) {
  const Recording recording(10);
  PlaySource source(recording.images, [](std::size_t index) {
    if (index == 7) throw Error("/x/7.png", "is truncated");
  });
  const RunOutcome outcome = RunSequential(*MakeSlam(recording), source, {});
  EXPECT_EQ(outcome.error, "/x/7.png: is truncated");
  EXPECT_EQ(outcome.trajectory.size(), 7U);
  EXPECT_LT(Ate_m(outcome.trajectory, recording), kMaxAte_m);
  EXPECT_TRUE(outcome.semantic_map);
}

TEST(RunSequential, ProgrammersErrorsAreNotTakenForBadInput) {
  const Recording recording(3);
  PlaySource source(recording.images, [](std::size_t index) {
    if (index == 2) throw std::logic_error("a defect");
  });
  EXPECT_THROW(RunSequential(*MakeSlam(recording), source, {}), std::logic_error);
}

TEST(RunSequential, WithoutFramesTheOutcomeIsEmpty) {
  const Recording recording(1);
  PlaySource source({});
  const RunOutcome outcome = RunSequential(*MakeSlam(recording), source, {});
  EXPECT_EQ(outcome.counts.frames, 0U);
  EXPECT_EQ(outcome.counts.keyframes, 0U);
  EXPECT_EQ(outcome.counts.mean_masked_share, 0);
  EXPECT_THAT(outcome.trajectory, IsEmpty());
  EXPECT_THAT(outcome.error, IsEmpty());
}

TEST(RunSequential, MakesNoSemanticMapWhereNoneIsWanted) {
  const Recording recording(4);
  SlamOptions options = test::QuickOptions();
  options.build_semantic_map = false;
  const RunOutcome outcome = RunOnce(recording, options);
  EXPECT_FALSE(outcome.semantic_map);
  EXPECT_EQ(outcome.counts.frames_tracked, 4U);
}

TEST(RunSequential, KeepsWhatWasComputedBeforeMappingFailed) {
  const Recording recording(8);
  const auto slam = MakeSlam(recording, test::KeyframesOften());
  test::FailingBackEnd back_end(*slam, test::BackEndStep::kRefine, 3, test::RunOutOfMemory);
  PlaySource source(recording.images);
  const RunOutcome outcome = RunSequential(*slam, back_end, source, {});
  EXPECT_EQ(outcome.error, std::bad_alloc().what());
  EXPECT_GE(outcome.trajectory.size(), 3U);
  EXPECT_LT(outcome.trajectory.size(), 8U);
  EXPECT_EQ(outcome.counts.keyframes, 3U);
  EXPECT_TRUE(outcome.semantic_map);
}

TEST(RunSequential, KeepsTheTrajectoryWhereTheMapCannotBeFinished) {
  const Recording recording(4);
  const auto slam = MakeSlam(recording);
  test::FailingBackEnd back_end(*slam, test::BackEndStep::kFinish, 1, test::RunOutOfMemory);
  PlaySource source(recording.images);
  const RunOutcome outcome = RunSequential(*slam, back_end, source, {});
  EXPECT_EQ(outcome.error, std::bad_alloc().what());
  EXPECT_EQ(outcome.trajectory.size(), 4U);
}

TEST(RunSequential, FollowsWhoWalksAsATrackAndMakesNoObjectOfHim) {
  const test::Recording recording(16);
  test::PlaySource source(recording.images);
  SlamOptions options = test::KeyframesOften();
  options.objects.tracks.min_duration_s = .3;
  const RunOutcome outcome = RunSequential(*test::MakeSlam(recording, options), source, {});
  ASSERT_TRUE(outcome.objects);
  EXPECT_EQ(outcome.objects->class_names, std::vector<std::string>{"person"});
  EXPECT_TRUE(outcome.objects->objects.empty());
  ASSERT_FALSE(outcome.objects->tracks.empty());
  const ObjectTrack& track = outcome.objects->tracks.front();
  EXPECT_EQ(track.class_id, ClassId(0));
  EXPECT_GT(track.points.size(), 4U);
}

TEST(RunSequential, MakesObjectsOfWhatNeverMovesAndNoneWhereNoneAreWanted) {
  const test::Recording recording(10);
  for (const bool wanted : {true, false}) {
    test::PlaySource source(recording.images);
    SlamOptions options = test::KeyframesOften();
    options.dynamics.dynamic_classes = {};
    options.dynamics.never_dynamic = {"person"};
    options.objects.join.min_confidence = 0;
    options.build_objects = wanted;
    const RunOutcome outcome = RunSequential(*test::MakeSlam(recording, options), source, {});
    ASSERT_EQ(outcome.objects.has_value(), wanted);
    if (!wanted) continue;
    EXPECT_FALSE(outcome.objects->objects.empty());
    EXPECT_TRUE(outcome.objects->tracks.empty());
    for (const SceneObject& object : outcome.objects->objects) EXPECT_GE(object.views, 2);
  }
}

}  // namespace
}  // namespace ofm
