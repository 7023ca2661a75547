// What the tracker makes of being told what moves.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "ofm/tracking/test_run.h"

namespace ofm {
namespace {

using test::DefaultWorld;
using test::ExpectPose;
using test::MadeFrame;
using test::TrackingRun;

/// The status after a jump by 0.3 m and 12 degrees at frame 5 that a hint tells of.
TrackingStatus StatusAfterJumpWithHint(const RigidTransform& hint, std::int64_t stamp_error_ns) {
  TrackingOptions options;
  options.doubtful_share = 0;  // nobody else is asked
  TrackingRun run(DefaultWorld(), options);
  for (std::uint32_t i = 0; i < 5; ++i) run.Step(i);
  const RigidTransform jump(ExpSo3({0, 0.2, 0}), {0.3, 0, 0});
  const MadeFrame before = run.world().Frame(4);
  const MadeFrame frame = run.world().Look(5, 0.5, jump * before.camera_from_world);
  const TrackingResult result = run.Step(frame, [&](TrackingInput& input) {
    input.motion_hint = {before.stamp_ns + stamp_error_ns, hint};
  });
  ExpectPose(result.camera_from_world, run.Truth(frame), 1e-3, 0.1);
  return result.status;
}

TEST(Tracker, MotionHintLeadsWhereConstantVelocityDoesNot) {
  const RigidTransform jump(ExpSo3({0, 0.2, 0}), {0.3, 0, 0});
  EXPECT_EQ(StatusAfterJumpWithHint(jump, 0), TrackingStatus::kTracked);
}

TEST(Tracker, MotionHintSinceAnotherFrameIsIgnored) {
  const RigidTransform jump(ExpSo3({0, 0.2, 0}), {0.3, 0, 0});
  EXPECT_EQ(StatusAfterJumpWithHint(jump, 1), TrackingStatus::kRelocalized);
  EXPECT_EQ(StatusAfterJumpWithHint(jump, -100'000'000), TrackingStatus::kRelocalized);
}

TEST(Tracker, WrongMotionHintCostsNoMoreThanARelocalisation) {
  const RigidTransform wrong(ExpSo3({0, -0.6, 0}), {1, 0, 0});
  EXPECT_EQ(StatusAfterJumpWithHint(wrong, 0), TrackingStatus::kRelocalized);
}

/// `frame` with every other landmark a pixel and a half to the right, where they may move.
MadeFrame WithShiftedHalf(const MadeFrame& frame, float static_probability) {
  MadeFrame changed = frame;
  FrameFeatures features = *frame.features;
  features.static_probability.assign(features.size(), 1.0F);
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (frame.shown[i].value % 2 != 0) continue;
    features.ideal_px[i].x() += 1.5F;
    features.static_probability[i] = static_probability;
  }
  changed.features = std::make_shared<const FrameFeatures>(std::move(features));
  return changed;
}

TEST(Tracker, FeaturesThatMayMoveCountLessForThePose) {
  const auto error_m = [](float static_probability) {
    TrackingRun run;
    for (std::uint32_t i = 0; i < 3; ++i) run.Step(i);
    const MadeFrame frame = WithShiftedHalf(run.world().Frame(3), static_probability);
    return test::DistanceOfCentres_m(run.Step(frame).camera_from_world, run.Truth(frame));
  };
  const double without = error_m(1), with = error_m(0.01F);
  EXPECT_GT(without, 5e-4);
  EXPECT_LT(with, 0.2 * without);
}

TEST(Tracker, LandmarksThatMayMoveCountLessForThePose) {
  const auto error_m = [](bool doubt) {
    TrackingRun run;
    run.Step(0);
    // The map's landmarks are the features of frame 0 that have depth.
    const Keyframe first = run.map().GetKeyframe(KeyframeId(0));
    const MadeFrame shown = run.world().Frame(0);
    for (std::size_t i = 0; i < shown.shown.size(); ++i) {
      if (shown.shown[i].value % 2 != 0 || !first.landmarks[i].valid()) continue;
      for (int k = 0; doubt && k < 40; ++k) {
        run.map().UpdateStaticProbability(first.landmarks[i], 0);
      }
    }
    const MadeFrame frame = WithShiftedHalf(run.world().Frame(1), 1);
    return test::DistanceOfCentres_m(run.Step(frame).camera_from_world, run.Truth(frame));
  };
  const double without = error_m(false), with = error_m(true);
  EXPECT_GT(without, 5e-4);
  EXPECT_LT(with, 0.2 * without);
}

/// A frame whose left half shows no features, and the depth of what is there: the landmarks
/// themselves, or something before them.
class TrackerSightings : public testing::Test {
 protected:
  TrackerSightings() {
    run_.Step(0);
    run_.Step(1);
    const MadeFrame whole = run_.world().Frame(2);
    std::vector<test::TestFeature> kept;
    frame_ = whole;
    frame_.shown.clear();
    depth_m_ = cv::Mat::zeros(camera_.height, camera_.width, CV_32FC1);
    for (std::size_t i = 0; i < whole.features->size(); ++i) {
      const FrameFeatures& f = *whole.features;
      const cv::Point pixel(f.ideal_px[i].cast<int>().x(), f.ideal_px[i].cast<int>().y());
      cv::Mat around =
          depth_m_(cv::Rect(pixel.x - 2, pixel.y - 2, 5, 5) & cv::Rect({}, depth_m_.size()));
      around = f.depth_m[i];
      if (pixel.x < camera_.width / 2) continue;
      kept.push_back({f.ideal_px[i], f.depth_m[i], f.keypoints[i].octave, f.descriptors[i], 0});
      frame_.shown.push_back(whole.shown[i]);
    }
    frame_.features = test::MakeTestFeatures(kept, camera_);
    mask_ = cv::Mat::zeros(depth_m_.size(), CV_8UC1);
    mask_.colRange(0, camera_.width / 2 - 8) = 255;
  }

  /// How many landmarks that were not found are said to move, and how many say nothing.
  std::pair<int, int> CountNotFound(const cv::Mat& depth_m, const cv::Mat& mask) {
    TrackingRun run;
    run.Step(0);
    run.Step(1);
    const TrackingResult result = run.Step(frame_, [&](TrackingInput& input) {
      input.depth_m = depth_m;
      input.moving_mask = mask;
    });
    EXPECT_EQ(result.status, TrackingStatus::kTracked);
    std::pair<int, int> counts;
    for (const Sighting& sighting : result.sightings) {
      if (sighting.found) {
        EXPECT_EQ(sighting.static_probability, 1.0F);
        continue;
      }
      if (sighting.static_probability) {
        EXPECT_EQ(*sighting.static_probability, 0);
      }
      (sighting.static_probability ? counts.first : counts.second) += 1;
    }
    return counts;
  }

  TrackingRun run_;
  PinholeCamera camera_ = run_.world().model().camera;
  MadeFrame frame_;
  cv::Mat depth_m_, mask_;
};

TEST_F(TrackerSightings, LandmarkAtTheDepthOfWhatMovesMoves) {
  const auto [moving, silent] = CountNotFound(depth_m_, mask_);
  EXPECT_GT(moving, 30);
  EXPECT_GT(moving, 2 * silent);
}

TEST_F(TrackerSightings, LandmarkBehindWhatMovesIsHiddenAndNothingIsSaid) {
  const auto [moving, silent] = CountNotFound(depth_m_ - 0.5, mask_);
  // Where two landmarks are near one another in the image, one may be at the depth of the other.
  EXPECT_LT(moving, 5);
  EXPECT_GT(silent, 30);
}

TEST_F(TrackerSightings, NothingIsSaidOfWhatIsNotFoundWithoutMaskOrDepth) {
  EXPECT_EQ(CountNotFound(depth_m_, {}).first, 0);
  EXPECT_EQ(CountNotFound({}, mask_).first, 0);
  EXPECT_EQ(CountNotFound(depth_m_ * 0, mask_).first, 0);
  EXPECT_EQ(CountNotFound(depth_m_, mask_ * 0).first, 0);
  EXPECT_GT(CountNotFound(depth_m_, {}).second, 30);
}

TEST_F(TrackerSightings, FoundLandmarksGoByTheirFeatures) {
  FrameFeatures features = *frame_.features;
  features.static_probability.assign(features.size(), 0.5F);
  frame_.features = std::make_shared<const FrameFeatures>(std::move(features));
  int found = 0;
  for (const Sighting& sighting : run_.Step(frame_).sightings) {
    if (sighting.found) {
      EXPECT_EQ(sighting.static_probability, 0.5F);
    }
    found += sighting.found;
  }
  EXPECT_GT(found, 50);
}

}  // namespace
}  // namespace ofm
