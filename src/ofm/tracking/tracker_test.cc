#include "ofm/tracking/tracker.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "ofm/tracking/test_run.h"

namespace ofm {
namespace {

using test::DefaultWorld;
using test::ExpectPose;
using test::FeatureWorld;
using test::FeatureWorldOptions;
using test::MadeFrame;
using test::TrackingRun;

FeatureWorldOptions WorldOf(CameraPathKind kind) {
  FeatureWorldOptions options = DefaultWorld();
  options.landmarks.path.kind = kind;
  return options;
}

TEST(Tracker, WaitsForAFrameWithEnoughFeaturesThatHaveDepth) {
  FeatureWorldOptions world = DefaultWorld();
  world.depthless_share = 0.9;
  TrackingRun run(world);
  const TrackingResult result = run.Step(0);
  EXPECT_EQ(result.status, TrackingStatus::kWaiting);
  EXPECT_FALSE(HasPose(result.status));
  EXPECT_FALSE(result.keyframe.has_value());
  EXPECT_EQ(run.Step(test::MakeBlindFrame(run.world().Frame(1))).status, TrackingStatus::kWaiting);
}

TEST(Tracker, FirstFrameBeginsTheMapAtTheOrigin) {
  TrackingRun run;
  const MadeFrame frame = run.world().Frame(7);
  const TrackingResult result = run.Step(frame);
  EXPECT_EQ(result.status, TrackingStatus::kInitialized);
  ExpectPose(result.camera_from_world, {}, 0, 0);
  ASSERT_TRUE(result.keyframe.has_value());
  EXPECT_EQ(result.keyframe->frame_id, FrameId(7));
  EXPECT_EQ(result.keyframe->stamp_ns, frame.stamp_ns);
  EXPECT_EQ(result.keyframe->features, frame.features);
  EXPECT_FALSE(result.keyframe->reference.valid());
  EXPECT_EQ(result.keyframe->landmarks.size(), frame.features->size());
}

class TrackerPaths : public testing::TestWithParam<CameraPathKind> {};

TEST_P(TrackerPaths, FollowsTheCameraWithinAMillimetre) {
  TrackingRun run(WorldOf(GetParam()));
  EXPECT_EQ(run.Step(0).status, TrackingStatus::kInitialized);
  for (std::uint32_t i = 1; i < 40; ++i) {
    const MadeFrame frame = run.world().Frame(i);
    const TrackingResult result = run.Step(frame);
    ASSERT_EQ(result.status, TrackingStatus::kTracked) << i;
    ExpectPose(result.camera_from_world, run.Truth(frame), 1e-3, 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, TrackerPaths,
                         testing::Values(CameraPathKind::kStatic, CameraPathKind::kXyz,
                                         CameraPathKind::kRpy, CameraPathKind::kHalfsphere));

TEST(Tracker, FollowsTheCameraWithNoisyFeatures) {
  FeatureWorldOptions world = DefaultWorld();
  world.pixel_sigma = 0.5;
  world.depth_sigma = 1.4e-3;
  world.depthless_share = 0.1;
  world.descriptor_noise_bits = 10;
  TrackingRun run(world);
  run.Step(0);
  double sum_m2 = 0;
  for (std::uint32_t i = 1; i < 40; ++i) {
    const MadeFrame frame = run.world().Frame(i);
    const TrackingResult result = run.Step(frame);
    ASSERT_EQ(result.status, TrackingStatus::kTracked) << i;
    ExpectPose(result.camera_from_world, run.Truth(frame), 0.02, 0.5);
    const double error_m = test::DistanceOfCentres_m(result.camera_from_world, run.Truth(frame));
    sum_m2 += error_m * error_m;
  }
  EXPECT_LT(std::sqrt(sum_m2 / 39), 0.008);
}

TEST(Tracker, PredictsWithConstantVelocityWhateverTheTimeBetweenFrames) {
  TrackingOptions options;
  options.search_radius_px = 3;  // so narrow that only a right prediction finds anything
  options.doubtful_share = 0;    // nobody else is asked
  TrackingRun run(DefaultWorld(), options);
  const RigidTransform start = run.world().Frame(0).camera_from_world;
  const Vector6d twist_per_s = (Vector6d() << 0.15, -0.05, 0.1, 0.02, 0.1, 0.05).finished();
  const auto look = [&](std::uint32_t id, double time_s) {
    return run.world().Look(id, time_s, ExpSe3(time_s * twist_per_s) * start);
  };
  double time_s = 0;
  run.Step(look(0, time_s));
  std::uint32_t id = 1;
  for (const double step_s : {0.02, 0.1, 0.3, 0.05, 0.4, 0.01, 0.3}) {
    time_s += step_s;
    const MadeFrame frame = look(id++, time_s);
    const TrackingResult result = run.Step(frame);
    EXPECT_EQ(result.status, TrackingStatus::kTracked) << "after " << step_s << " s";
    ExpectPose(result.camera_from_world, run.Truth(frame), 1e-3, 0.1);
  }
}

TEST(Tracker, TellsWhereTheCameraWasWhenTheDepthWasTaken) {
  TrackingRun run(DefaultWorld());
  const RigidTransform start = run.world().Frame(0).camera_from_world;
  const Vector6d twist_per_s = (Vector6d() << 0.3, 0, 0.1, 0, 0.2, 0).finished();
  TrackingResult result;
  for (std::uint32_t id = 0; id < 4; ++id) {
    const double time_s = .03 * id;
    const MadeFrame frame = run.world().Look(id, time_s, ExpSe3(time_s * twist_per_s) * start);
    result = run.Step(frame, [](TrackingInput& input) {
      input.depth_m = cv::Mat(480, 640, CV_32FC1, cv::Scalar(0));
      input.depth_stamp_ns = input.stamp_ns + 20'000'000;
    });
    if (id < 1) ExpectPose(result.depth_from_color, {}, 1e-12, 1e-9);
  }
  ExpectPose(result.depth_from_color, ExpSe3(.02 * twist_per_s), 1e-4, 0.01);
}

TEST(Tracker, SurvivesDroppedFrames) {
  TrackingRun run;
  for (const std::uint32_t i : {0U, 1U, 2U, 4U, 5U, 8U, 9U, 11U}) {
    const MadeFrame frame = run.world().Frame(i);
    const TrackingResult result = run.Step(frame);
    ASSERT_TRUE(HasPose(result.status)) << i;
    EXPECT_NE(result.status, TrackingStatus::kRelocalized) << i;
    ExpectPose(result.camera_from_world, run.Truth(frame), 1e-3, 0.1);
  }
}

TEST(Tracker, IsLostWhenNothingIsSeenAndRelocalisesAfterwards) {
  TrackingRun run;
  for (std::uint32_t i = 0; i < 5; ++i) run.Step(i);
  for (std::uint32_t i = 5; i < 8; ++i) {
    const TrackingResult lost = run.Step(test::MakeBlindFrame(run.world().Frame(i)));
    EXPECT_EQ(lost.status, i == 5 ? TrackingStatus::kReckoned : TrackingStatus::kLost);
    EXPECT_FALSE(lost.keyframe.has_value());
    EXPECT_EQ(lost.inliers, 0);
  }
  const MadeFrame back = run.world().Frame(12);
  const TrackingResult found = run.Step(back);
  EXPECT_EQ(found.status, TrackingStatus::kRelocalized);
  ExpectPose(found.camera_from_world, run.Truth(back), 1e-3, 0.1);
  const MadeFrame next = run.world().Frame(13);
  const TrackingResult result = run.Step(next);
  EXPECT_EQ(result.status, TrackingStatus::kTracked);
  ExpectPose(result.camera_from_world, run.Truth(next), 1e-3, 0.1);
}

/// Tells the tracker how the camera moved from frame `id - 1` to `id`.
std::function<void(TrackingInput&)> TrueMotion(const FeatureWorld& world, std::uint32_t id) {
  const MadeFrame last = world.Frame(id - 1), current = world.Frame(id);
  return [=](TrackingInput& input) {
    input.motion_hint = {last.stamp_ns,
                         current.camera_from_world * last.camera_from_world.Inverse()};
  };
}

TEST(Tracker, ReckonsThroughBlindFramesByTheCamerasMeasuredMotion) {
  TrackingRun run;
  for (std::uint32_t i = 0; i < 5; ++i) run.Step(i);
  for (std::uint32_t i = 5; i < 12; ++i) {
    const MadeFrame frame = run.world().Frame(i);
    const TrackingResult result = run.Step(test::MakeBlindFrame(frame), TrueMotion(run.world(), i));
    ASSERT_EQ(result.status, TrackingStatus::kReckoned) << i;
    EXPECT_EQ(result.inliers, 0);
    EXPECT_FALSE(result.keyframe.has_value()) << "nothing to continue the map with";
    ExpectPose(result.camera_from_world, run.Truth(frame), 1e-3, 0.1);
  }
  const MadeFrame back = run.world().Frame(12);
  const TrackingResult found = run.Step(back, TrueMotion(run.world(), 12));
  EXPECT_EQ(found.status, TrackingStatus::kTracked) << "no need to relocalise";
  ExpectPose(found.camera_from_world, run.Truth(back), 1e-3, 0.1);
}

TEST(Tracker, ReckonsOnlyForSoLong) {
  TrackingOptions options;
  options.dead_reckoning.max_s = 0.3;  // three frames
  TrackingRun run(DefaultWorld(), options);
  for (std::uint32_t i = 0; i < 5; ++i) run.Step(i);
  for (std::uint32_t i = 5; i < 12; ++i) {
    const MadeFrame blind = test::MakeBlindFrame(run.world().Frame(i));
    const TrackingStatus status = run.Step(blind, TrueMotion(run.world(), i)).status;
    const std::int64_t since_ns = blind.stamp_ns - run.world().Frame(4).stamp_ns;
    EXPECT_EQ(status, since_ns <= 300'000'000 ? TrackingStatus::kReckoned : TrackingStatus::kLost);
  }
}

/// The camera turns to where no landmark is: all that it sees there is new.
TEST(Tracker, ContinuesTheMapFromAReckonedPose) {
  TrackingOptions options;
  options.dead_reckoning.keyframe_s = 0.35;  // at 10 frames per second
  TrackingRun run(DefaultWorld(), options);
  FeatureWorldOptions elsewhere = DefaultWorld();
  elsewhere.landmarks.seed += 1;
  const FeatureWorld other(elsewhere);
  for (std::uint32_t i = 0; i < 5; ++i) run.Step(i);
  std::uint32_t continued = 0;
  for (std::uint32_t i = 5; i < 20; ++i) {
    const MadeFrame frame = other.Frame(i);
    const TrackingResult result = run.Step(frame, TrueMotion(run.world(), i));
    ASSERT_EQ(result.status, continued == 0 ? TrackingStatus::kReckoned : TrackingStatus::kTracked)
        << i;
    ExpectPose(result.camera_from_world, run.Truth(run.world().Frame(i)), 2e-3, 0.1);
    if (continued == 0 && result.keyframe) continued = i;
  }
  EXPECT_EQ(continued, 8U) << "the first frame after 0.35 s";
}

TEST(Tracker, StaysLostInAPlaceThatItDoesNotKnow) {
  TrackingRun run;
  for (std::uint32_t i = 0; i < 5; ++i) run.Step(i);
  FeatureWorldOptions other = DefaultWorld();
  other.landmarks.seed = 99;
  const FeatureWorld elsewhere(other);
  for (std::uint32_t i = 5; i < 8; ++i) {
    const TrackingResult result = run.Step(elsewhere.Frame(i));
    EXPECT_EQ(result.status, i == 5 ? TrackingStatus::kReckoned : TrackingStatus::kLost);
    EXPECT_TRUE(std::none_of(result.landmarks.begin(), result.landmarks.end(),
                             [](LandmarkId id) { return id.valid(); }));
  }
}

/// The status after a jump by 0.3 m and 12 degrees at frame 5.
TrackingStatus StatusAfterJump(const TrackingOptions& options) {
  TrackingRun run(DefaultWorld(), options);
  for (std::uint32_t i = 0; i < 5; ++i) run.Step(i);
  const RigidTransform jump(ExpSo3({0, 0.2, 0}), {0.3, 0, 0});
  const MadeFrame before = run.world().Frame(4);
  const MadeFrame frame = run.world().Look(5, 0.5, jump * before.camera_from_world);
  const TrackingResult result = run.Step(frame);
  ExpectPose(result.camera_from_world, run.Truth(frame), 1e-3, 0.1);
  return result.status;
}

TEST(Tracker, AsksTheKeyframeWhenTheLastFrameDoesNotLeadOn) {
  TrackingOptions options;
  options.doubtful_share = 0.4;
  EXPECT_EQ(StatusAfterJump(options), TrackingStatus::kTracked);
  options.doubtful_share = 0;
  EXPECT_EQ(StatusAfterJump(options), TrackingStatus::kRelocalized) << "without second opinion";
}

TEST(Tracker, FollowsAMapThatWasMovedUnderIt) {
  TrackingRun run;
  for (std::uint32_t i = 0; i < 5; ++i) run.Step(i);
  const RigidTransform moved_from_map(ExpSo3({0.1, 0.2, -0.1}), {0.5, -0.3, 0.2});
  std::vector<KeyframeId> keyframes;
  std::vector<LandmarkId> landmarks;
  run.map().keyframes().ForEach([&](const Keyframe& k) { keyframes.push_back(k.id); });
  run.map().landmarks().ForEach([&](const Landmark& l) { landmarks.push_back(l.id); });
  for (const KeyframeId id : keyframes) {
    run.map().SetKeyframePose(
        id, run.map().GetKeyframe(id).camera_from_world * moved_from_map.Inverse());
  }
  for (const LandmarkId id : landmarks) {
    run.map().SetLandmarkPosition(id, moved_from_map * run.map().GetLandmark(id).position_in_world);
    run.map().RefreshLandmark(id);
  }
  const MadeFrame frame = run.world().Frame(5);
  const TrackingResult result = run.Step(frame);
  EXPECT_EQ(result.status, TrackingStatus::kTracked);
  ExpectPose(result.camera_from_world, run.Truth(frame) * moved_from_map.Inverse(), 1e-3, 0.1);
}

TEST(Tracker, KeyframeCandidateTellsWhatTheResultTells) {
  TrackingOptions options;
  options.keyframe.max_frames = 3;
  options.keyframe.inlier_ratio = 0.3;  // nothing else calls for one
  options.keyframe.close_tracked = 0;
  TrackingRun run(DefaultWorld(), options);
  run.Step(0);
  std::vector<std::uint32_t> made;
  for (std::uint32_t i = 1; i < 10; ++i) {
    const TrackingResult result = run.Step(i);
    const auto reference = run.map().Snapshot()->FindKeyframePose(result.reference);
    ASSERT_TRUE(reference.has_value());
    ExpectPose(result.camera_from_reference * *reference, result.camera_from_world, 1e-9, 1e-5);
    if (!result.keyframe) continue;
    made.push_back(i);
    EXPECT_EQ(result.keyframe->frame_id, FrameId(i));
    EXPECT_EQ(result.keyframe->reference, result.reference);
    EXPECT_EQ(result.keyframe->landmarks, result.landmarks);
    ExpectPose(result.keyframe->camera_from_world, result.camera_from_world, 0, 1e-5);
    ExpectPose(result.keyframe->camera_from_reference, result.camera_from_reference, 0, 1e-5);
  }
  EXPECT_EQ(made.size(), 3U) << "every third frame";
}

TEST(Tracker, SightingsAreTheLandmarksLookedForEachOnce) {
  TrackingRun run;
  run.Step(0);
  for (std::uint32_t i = 1; i < 4; ++i) {
    const TrackingResult result = run.Step(i);
    std::set<LandmarkId> looked_for, found, named;
    for (const Sighting& sighting : result.sightings) {
      EXPECT_TRUE(looked_for.insert(sighting.landmark).second) << "twice";
      if (sighting.found) found.insert(sighting.landmark);
    }
    for (const LandmarkId id : result.landmarks) {
      if (!id.valid()) continue;
      EXPECT_TRUE(named.insert(id).second) << "a landmark in two features";
    }
    EXPECT_EQ(found, named);
    EXPECT_EQ(static_cast<int>(named.size()), result.inliers);
  }
}

TEST(Tracker, GivesTheSameBytesEveryTime) {
  FeatureWorldOptions world = DefaultWorld();
  world.pixel_sigma = 0.5;
  world.descriptor_noise_bits = 10;
  TrackingRun a(world), b(world);
  for (std::uint32_t i = 0; i < 12; ++i) {
    // Two blind frames, so that the next one draws random samples.
    const MadeFrame made = a.world().Frame(i);
    const MadeFrame frame = i == 6 || i == 7 ? test::MakeBlindFrame(made) : made;
    const TrackingResult ra = a.Step(frame), rb = b.Step(frame);
    EXPECT_EQ(ra.status, rb.status);
    EXPECT_EQ(ra.landmarks, rb.landmarks);
    EXPECT_EQ(ra.camera_from_world.translation(), rb.camera_from_world.translation());
    EXPECT_EQ(ra.camera_from_world.rotation().coeffs(), rb.camera_from_world.rotation().coeffs());
    EXPECT_EQ(ra.status == TrackingStatus::kRelocalized, i == 8);
  }
}

}  // namespace
}  // namespace ofm
