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

/// Above what these small images give (more than the sequential runner's: which frames become key
/// frames is up to the threads' timing), far below the path's extent.
constexpr double kMaxAte_m = 0.03, kMaxLiveAte_m = 0.03;

double Ate_m(const Trajectory& estimate, const Recording& recording) {
  return ComputeAte(estimate, recording.sequence.GroundTruth()).translation_m.rmse;
}

/// Fails at a frame, by an exception that `fail` throws.
class FailingSegmenter : public test::TruthSegmenter {
 public:
  FailingSegmenter(const SimSequence& sequence, FrameId frame, std::function<void()> fail)
      : TruthSegmenter(sequence), frame_(frame), fail_(std::move(fail)) {}
  Segmentation Segment(const RgbdFrame& frame) override {
    if (frame.id == frame_) fail_();
    return TruthSegmenter::Segment(frame);
  }

 private:
  FrameId frame_;
  std::function<void()> fail_;
};

TEST(RunThreaded, TracksEveryFrameAsExactlyAsTheSequentialRunner) {
  const Recording recording(24);
  PlaySource source(recording.images);
  const RunOutcome outcome = RunThreaded(*MakeSlam(recording), source, {});
  EXPECT_THAT(outcome.error, IsEmpty());
  EXPECT_EQ(outcome.counts.frames, 24U);
  EXPECT_EQ(outcome.counts.frames_tracked, 24U);
  EXPECT_EQ(outcome.trajectory.size(), 24U);
  EXPECT_LT(Ate_m(outcome.trajectory, recording), kMaxAte_m);
  EXPECT_LT(Ate_m(outcome.live_trajectory, recording), kMaxLiveAte_m);
  EXPECT_GE(outcome.counts.keyframes, 1U);
  EXPECT_GT(outcome.counts.landmarks, 100U);
  ASSERT_TRUE(outcome.semantic_map);
  EXPECT_GT(outcome.semantic_map->cloud_in_world.size(), 500U);
}

TEST(RunThreaded, TellsTheTimeOfTheStagesOfAllThreads) {
  const Recording recording(6);
  PlaySource source(recording.images);
  const RunOutcome outcome = RunThreaded(*MakeSlam(recording), source, {});
  for (const char* stage : {"segmentation", "features", "tracking"}) {
    ASSERT_THAT(outcome.times.stages(), Contains(Key(stage)));
    EXPECT_EQ(outcome.times.stages().at(stage).wall_ms.size(), 6U) << stage;
  }
  EXPECT_THAT(outcome.times.stages(), Contains(Key("keyframe_insertion")));
  EXPECT_GT(outcome.wall_s, 0);
}

TEST(RunThreaded, TellsObserversOfEveryFrameInOrder) {
  const Recording recording(8);
  std::vector<std::size_t> done;
  test::CallingObserver observer(
      [&](const FrameReport& report) { done.push_back(report.frames_done); });
  PlaySource source(recording.images);
  RunThreaded(*MakeSlam(recording), source, {{&observer}, {}});
  EXPECT_THAT(done, testing::ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
}

TEST(RunThreaded, StopsWhenAskedToAndKeepsTheResults) {
  const Recording recording(20);
  std::stop_source stop;
  test::CallingObserver observer([&](const FrameReport& report) {
    if (report.frames_done == 4) stop.request_stop();
  });
  PlaySource source(recording.images);
  const RunOutcome outcome =
      RunThreaded(*MakeSlam(recording), source, {{&observer}, stop.get_token()});
  EXPECT_GE(outcome.trajectory.size(), 4U);
  EXPECT_LE(outcome.trajectory.size(), 8U) << "but for those already prepared";
  EXPECT_THAT(outcome.error, IsEmpty());
  EXPECT_TRUE(outcome.semantic_map);
}

TEST(RunThreaded, KeepsWhatWasComputedBeforeTheSourceFailed) {
  const Recording recording(10);
  PlaySource source(recording.images, [](std::size_t index) {
    if (index == 7) throw Error("/x/7.png", "is truncated");
  });
  const RunOutcome outcome = RunThreaded(*MakeSlam(recording), source, {});
  EXPECT_EQ(outcome.error, "/x/7.png: is truncated");
  EXPECT_EQ(outcome.trajectory.size(), 7U);
  EXPECT_TRUE(outcome.semantic_map);
}

TEST(RunThreaded, KeepsWhatWasComputedBeforeTheSegmenterFailed) {
  const Recording recording(8);
  Slam slam(recording.sequence.camera(), test::QuickOptions(),
            std::make_unique<FailingSegmenter>(recording.sequence, FrameId(5),
                                               [] { CV_Error(cv::Error::StsError, "no"); }));
  PlaySource source(recording.images);
  const RunOutcome outcome = RunThreaded(slam, source, {});
  EXPECT_THAT(outcome.error, testing::HasSubstr("no"));
  EXPECT_EQ(outcome.trajectory.size(), 5U);
}

TEST(RunThreaded, ProgrammersErrorsOfAnyThreadReachTheCaller) {
  const Recording recording(4);
  Slam slam(recording.sequence.camera(), test::QuickOptions(),
            std::make_unique<FailingSegmenter>(recording.sequence, FrameId(2),
                                               [] { throw std::logic_error("a defect"); }));
  PlaySource source(recording.images);
  EXPECT_THROW(RunThreaded(slam, source, {}), std::logic_error);
}

TEST(RunThreaded, KeepsWhatWasComputedBeforeMappingFailed) {
  const Recording recording(24);
  const auto slam = MakeSlam(recording, test::KeyframesOften());
  test::FailingBackEnd back_end(*slam, test::BackEndStep::kInsert, 3, test::RunOutOfMemory);
  PlaySource source(recording.images);
  const RunOutcome outcome = RunThreaded(*slam, back_end, source, {});
  EXPECT_EQ(outcome.error, std::bad_alloc().what());
  EXPECT_GE(outcome.trajectory.size(), 3U) << "each keyframe is a frame";
  EXPECT_EQ(outcome.trajectory.size(), outcome.counts.frames_tracked);
  EXPECT_LT(Ate_m(outcome.trajectory, recording), kMaxAte_m);
  EXPECT_EQ(outcome.counts.keyframes, 2U);
  EXPECT_TRUE(outcome.semantic_map);
}

TEST(RunThreaded, KeepsWhatWasComputedBeforeRefiningFailed) {
  const Recording recording(6);
  const auto slam = MakeSlam(recording);
  test::FailingBackEnd back_end(*slam, test::BackEndStep::kRefine, 1, test::RunOutOfMemory);
  PlaySource source(recording.images);
  const RunOutcome outcome = RunThreaded(*slam, back_end, source, {});
  EXPECT_EQ(outcome.error, std::bad_alloc().what());
  EXPECT_GE(outcome.trajectory.size(), 1U);
  EXPECT_GE(outcome.counts.keyframes, 1U);
  EXPECT_TRUE(outcome.semantic_map);
}

TEST(RunThreaded, EndsWhereMappingFailsBeforeThereIsAMap) {
  const Recording recording(4);
  const auto slam = MakeSlam(recording);
  test::FailingBackEnd back_end(*slam, test::BackEndStep::kInsert, 1, test::RunOutOfMemory);
  PlaySource source(recording.images);
  const RunOutcome outcome = RunThreaded(*slam, back_end, source, {});
  EXPECT_EQ(outcome.error, std::bad_alloc().what());
  EXPECT_EQ(outcome.counts.keyframes, 0U);
  EXPECT_LE(outcome.trajectory.size(), 1U) << "the frame that would have begun the map";
  ASSERT_TRUE(outcome.map);
}

TEST(RunThreaded, KeepsTheTrajectoryWhereTheMapCannotBeFinished) {
  const Recording recording(6);
  const auto slam = MakeSlam(recording);
  test::FailingBackEnd back_end(*slam, test::BackEndStep::kFinish, 1, test::RunOutOfMemory);
  PlaySource source(recording.images);
  const RunOutcome outcome = RunThreaded(*slam, back_end, source, {});
  EXPECT_EQ(outcome.error, std::bad_alloc().what());
  EXPECT_EQ(outcome.trajectory.size(), 6U);
  EXPECT_FALSE(outcome.semantic_map);
}

TEST(RunThreaded, ProgrammersErrorsInMappingReachTheCaller) {
  const Recording recording(24);
  const auto slam = MakeSlam(recording, test::KeyframesOften());
  test::FailingBackEnd back_end(*slam, test::BackEndStep::kInsert, 2,
                                [] { throw std::logic_error("a defect"); });
  PlaySource source(recording.images);
  EXPECT_THROW(RunThreaded(*slam, back_end, source, {}), std::logic_error);
}

TEST(RunThreaded, AnObserversErrorEndsTheThreadsAndReachesTheCaller) {
  const Recording recording(12);
  test::CallingObserver observer([](const FrameReport& report) {
    if (report.frames_done == 3) throw std::logic_error("a defect");
  });
  PlaySource source(recording.images);
  EXPECT_THROW(RunThreaded(*MakeSlam(recording), source, {{&observer}, {}}), std::logic_error);
}

TEST(RunThreaded, WithoutFramesTheOutcomeIsEmpty) {
  const Recording recording(1);
  PlaySource source({});
  const RunOutcome outcome = RunThreaded(*MakeSlam(recording), source, {});
  EXPECT_EQ(outcome.counts.frames, 0U);
  EXPECT_THAT(outcome.trajectory, IsEmpty());
}

TEST(RunThreaded, SystemsInOneProcessDoNotDisturbOneAnother) {
  const Recording recording(8), other(8, 2);
  RunOutcome first, second;
  {
    std::jthread a([&] {
      PlaySource source(recording.images);
      first = RunThreaded(*MakeSlam(recording), source, {});
    });
    std::jthread b([&] {
      PlaySource source(other.images);
      second = RunThreaded(*MakeSlam(other), source, {});
    });
  }
  EXPECT_LT(Ate_m(first.trajectory, recording), kMaxAte_m);
  EXPECT_LT(Ate_m(second.trajectory, other), kMaxAte_m);
  EXPECT_EQ(first.counts.frames_tracked, 8U);
  EXPECT_EQ(second.counts.frames_tracked, 8U);
}

}  // namespace
}  // namespace ofm
