// A camera that is carried to another room while nobody looks.
#include <gtest/gtest.h>

#include "ofm/map/submap.h"
#include "ofm/map/test_map.h"
#include "ofm/perception/null_segmenter.h"
#include "ofm/pipeline/test_support.h"

namespace ofm {
namespace {

using test::PlaySource;
using test::Recording;

constexpr int kHere = 6, kCovered = 3, kThere = 24;

/// kHere frames of a room, some with the camera covered, and kThere of the room's mirror image.
class CarriedCamera : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    recording_ = std::make_unique<Recording>(kHere + kCovered + kThere, 1, 0);
    frames_ = recording_->images;
    for (std::size_t i = kHere; i < frames_.size(); ++i) {
      const bool covered = i < kHere + kCovered;
      for (cv::Mat* image : {&frames_[i].color, &frames_[i].gray, &frames_[i].depth_m}) {
        cv::Mat changed = cv::Mat::zeros(image->size(), image->type());
        if (!covered) cv::flip(*image, changed, 1);
        *image = changed;
      }
    }
  }
  static void TearDownTestSuite() {
    recording_.reset();
    frames_.clear();
  }
  static SlamOptions Options() {
    SlamOptions options = test::KeyframesOften();
    options.build_semantic_map = false;
    options.tracking.submap.begin_after_s = 0.1;  // two frames
    return options;
  }
  using Runner = RunOutcome (*)(Slam&, FrameSource&, const RunContext&);
  static RunOutcome Run(const SlamOptions& options, Runner runner,
                        std::shared_ptr<const MapSnapshot> map = nullptr) {
    PlaySource source(frames_);
    Slam slam(recording_->sequence.camera(), options, std::make_unique<NullSegmenter>(),
              std::move(map));
    return runner(slam, source, {});
  }

  /// Of the first frames alone.
  static std::shared_ptr<const MapSnapshot> MapOfHere() {
    PlaySource source({frames_.begin(), frames_.begin() + kHere});
    return RunSequential(*test::MakeSlam(*recording_, Options()), source, {}).map;
  }

  static std::unique_ptr<Recording> recording_;
  static std::vector<RgbdFrame> frames_;
};

std::unique_ptr<Recording> CarriedCamera::recording_;
std::vector<RgbdFrame> CarriedCamera::frames_;

TEST_F(CarriedCamera, ResultsAreOfTheLargestSubmapAlone) {
  for (const Runner runner : {Runner{&RunSequential}, Runner{&RunThreaded}}) {
    const RunOutcome outcome = Run(Options(), runner);
    EXPECT_EQ(outcome.counts.submaps_begun, 1U);
    ASSERT_EQ(outcome.unjoined.size(), 1U);
    EXPECT_EQ(outcome.submap, LargestSubmap(*outcome.map));
    EXPECT_EQ(test::FindProblem(*outcome.map), "");
    EXPECT_EQ(outcome.trajectory.size() + outcome.unjoined.front().trajectory.size(),
              outcome.counts.frames_tracked);
    // The threaded runner begins a sub-map when mapping waits for nothing, whenever that is.
    EXPECT_GE(outcome.counts.frames_tracked, kHere + kThere - 12U);
    EXPECT_EQ(outcome.unjoined.front().id, SubmapId(0));
    EXPECT_GE(outcome.unjoined.front().trajectory.size(), static_cast<std::size_t>(kHere));
    for (const Trajectory* trajectory :
         {&outcome.trajectory, &outcome.live_trajectory, &outcome.keyframe_trajectory}) {
      ASSERT_FALSE(trajectory->empty());
      EXPECT_GE(trajectory->front().stamp_ns, frames_.at(kHere + kCovered).stamp_ns);
    }
  }
}

TEST_F(CarriedCamera, StaysLostWithoutSubmaps) {
  SlamOptions options = Options();
  options.tracking.submap.enabled = false;
  const RunOutcome outcome = Run(options, &RunSequential);
  EXPECT_EQ(outcome.counts.submaps_begun, 0U);
  EXPECT_TRUE(outcome.unjoined.empty());
  EXPECT_LE(outcome.trajectory.size(), kHere + 1U);
}

TEST_F(CarriedCamera, WithALoadedMapResultsAreInItsWorld) {
  const RunOutcome outcome = Run(Options(), &RunSequential, MapOfHere());
  EXPECT_EQ(outcome.submap, SubmapId(0));
  ASSERT_EQ(outcome.unjoined.size(), 1U);
  EXPECT_GT(outcome.unjoined.front().trajectory.size(), outcome.trajectory.size());
  EXPECT_LE(outcome.trajectory.back().stamp_ns, frames_.at(kHere).stamp_ns);
}

TEST_F(CarriedCamera, LocaliseOnlyBeginsNone) {
  SlamOptions options = Options();
  options.localize_only = true;
  const RunOutcome outcome = Run(options, &RunSequential, MapOfHere());
  EXPECT_EQ(outcome.counts.submaps_begun, 0U);
  EXPECT_EQ(FindSubmaps(*outcome.map).size(), 1U);
}

}  // namespace
}  // namespace ofm
