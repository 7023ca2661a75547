// Whole runs in mode `full`, with segmenters good and bad.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/eval/evaluation.h"
#include "ofm/perception/null_segmenter.h"
#include "ofm/pipeline/test_support.h"

namespace ofm {
namespace {

using test::Recording;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kFrames = 20;

const Recording& WalkingRecording() {
  static const Recording recording(kFrames);
  return recording;
}

/// Sees a person in the whole image from frame 6 on, for two frames or for ever; or fails there.
class BadSegmenter : public Segmenter {
 public:
  enum class Kind { kTwoFullMasks, kFullMasks, kFails };
  explicit BadSegmenter(Kind kind) : kind_(kind) {}

  Segmentation Segment(const RgbdFrame& frame) override {
    Segmentation segmentation{frame.id, {}};
    const bool is_good = frame.id.value < 6 || (kind_ != Kind::kFullMasks && frame.id.value > 7);
    if (is_good) return segmentation;
    if (kind_ == Kind::kFails) throw Error("the network failed");
    const cv::Mat all(frame.gray.size(), CV_8UC1, cv::Scalar(255));
    segmentation.instances.push_back(
        {InstanceId(1), ClassId(0), 1.0F, cv::Rect({}, all.size()), all});
    return segmentation;
  }
  const std::vector<std::string>& class_names() const override { return class_names_; }

 private:
  Kind kind_;
  std::vector<std::string> class_names_ = {"person"};
};

RunOutcome RunWith(std::unique_ptr<Segmenter> segmenter, SlamOptions options) {
  options.dynamics.mode = DynamicsMode::kFull;
  options.build_semantic_map = false;
  Slam slam(WalkingRecording().sequence.camera(), options, std::move(segmenter));
  test::PlaySource source(WalkingRecording().images);
  return RunSequential(slam, source, {});
}

RunOutcome RunWith(BadSegmenter::Kind kind, const SlamOptions& options = test::QuickOptions()) {
  return RunWith(std::make_unique<BadSegmenter>(kind), options);
}

double Ate_m(const Trajectory& estimate) {
  return ComputeAte(estimate, WalkingRecording().sequence.GroundTruth()).translation_m.rmse;
}

TEST(FullCulling, TracksWithAndWithoutASegmenter) {
  const auto with = RunWith(std::make_unique<test::TruthSegmenter>(WalkingRecording().sequence),
                            test::QuickOptions());
  const auto without = RunWith(std::make_unique<NullSegmenter>(), test::QuickOptions());
  for (const RunOutcome* outcome : {&with, &without}) {
    EXPECT_THAT(outcome->error, IsEmpty());
    EXPECT_EQ(outcome->counts.frames_tracked, static_cast<std::size_t>(kFrames));
    EXPECT_LT(Ate_m(outcome->trajectory), 0.02);
    EXPECT_GT(outcome->counts.mean_masked_share, 0.005);
  }
}

TEST(FullCulling, MasksOverTheWholeImageAreOutlived) {
  for (const auto kind : {BadSegmenter::Kind::kTwoFullMasks, BadSegmenter::Kind::kFullMasks}) {
    const RunOutcome outcome = RunWith(kind);
    EXPECT_THAT(outcome.error, IsEmpty());
    EXPECT_EQ(outcome.counts.frames_tracked, static_cast<std::size_t>(kFrames));
    EXPECT_EQ(outcome.counts.losses, 0U);
    EXPECT_LT(Ate_m(outcome.trajectory), 0.02);
  }
}

TEST(FullCulling, SegmenterThatFailsEndsTheRunAndKeepsItsResults) {
  SlamOptions options = test::QuickOptions();
  options.perception.schedule.on_failure = SegmentationFailure::kStop;
  const RunOutcome outcome = RunWith(BadSegmenter::Kind::kFails, options);
  EXPECT_THAT(outcome.error, HasSubstr("the network failed"));
  EXPECT_EQ(outcome.trajectory.size(), 6U);
  EXPECT_LT(Ate_m(outcome.trajectory), 0.03) << "the walker is not yet believed to move";
  EXPECT_GT(outcome.counts.landmarks, 100U);
}

TEST(FullCulling, SegmenterThatFailsIsDoneWithoutWhereThatIsWanted) {
  SlamOptions options = test::QuickOptions();
  options.perception.schedule.on_failure = SegmentationFailure::kContinue;
  const RunOutcome outcome = RunWith(BadSegmenter::Kind::kFails, options);
  EXPECT_THAT(outcome.error, IsEmpty());
  EXPECT_EQ(outcome.counts.frames_tracked, static_cast<std::size_t>(kFrames));
  EXPECT_LT(Ate_m(outcome.trajectory), 0.02);
}

}  // namespace
}  // namespace ofm
