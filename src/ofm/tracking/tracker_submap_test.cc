// What the tracker does where it stays lost.
#include <gtest/gtest.h>

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

/// At 10 frames per second: the third frame after the first lost one.
TrackingOptions BeginAfterAQuarter() {
  TrackingOptions options;
  options.submap.begin_after_s = 0.25;
  return options;
}

FeatureWorld Elsewhere() {
  FeatureWorldOptions options = DefaultWorld();
  options.landmarks.seed = 99;
  return FeatureWorld(options);
}

/// Sub-maps of the landmarks that a frame's pose is made of.
std::set<SubmapId> SubmapsOf(const Map& map, const TrackingResult& result) {
  std::set<SubmapId> submaps;
  for (const LandmarkId id : result.landmarks) {
    const Landmark* landmark = map.FindLandmark(id);
    if (landmark != nullptr) submaps.insert(map.FindSubmap(landmark->first_keyframe));
  }
  return submaps;
}

/// A camera that is somewhere else from frame 5 on.
class TrackerSubmap : public testing::Test {
 protected:
  void Begin(TrackingRun& run) {
    for (std::uint32_t i = 0; i < 5; ++i) run.Step(i);
  }
  /// Up to the frame that begins a sub-map, but no further than `end`; gives the next frame.
  std::uint32_t Leave(TrackingRun& run, std::uint32_t end = 12) {
    std::uint32_t i = 5;
    while (i < end && run.Step(elsewhere_.Frame(i++)).status != TrackingStatus::kInitialized) {
    }
    return i;
  }

  const FeatureWorld elsewhere_ = Elsewhere();
};

TEST_F(TrackerSubmap, BeginsAfterTheSetTimeAndGoesOnThere) {
  TrackingRun run(DefaultWorld(), BeginAfterAQuarter());
  Begin(run);
  const RigidTransform last_known = run.Truth(run.world().Frame(4));
  EXPECT_EQ(run.Step(elsewhere_.Frame(5)).status, TrackingStatus::kReckoned);
  for (std::uint32_t i = 6; i < 9; ++i) {
    EXPECT_EQ(run.Step(elsewhere_.Frame(i)).status, TrackingStatus::kLost) << i;
  }
  const TrackingResult begun = run.Step(elsewhere_.Frame(9));
  EXPECT_EQ(begun.status, TrackingStatus::kInitialized);
  ASSERT_TRUE(begun.keyframe);
  EXPECT_TRUE(begun.keyframe->begins_submap);
  EXPECT_FALSE(begun.keyframe->reference.valid());
  EXPECT_LT(test::DistanceOfCentres_m(begun.camera_from_world, last_known), 0.1) << "a guess";
  const SubmapId submap = run.map().GetKeyframe(run.map().latest_keyframe()).submap;
  EXPECT_NE(submap, SubmapId(0));
  for (std::uint32_t i = 10; i < 20; ++i) {
    const MadeFrame frame = elsewhere_.Frame(i);
    const TrackingResult result = run.Step(frame);
    ASSERT_EQ(result.status, TrackingStatus::kTracked) << i;
    ExpectPose(result.camera_from_world, run.Truth(frame), 1e-3, 0.1);
    EXPECT_EQ(SubmapsOf(run.map(), result), std::set{submap});
  }
  EXPECT_EQ(test::FindProblem(run.map()), "");
}

TEST_F(TrackerSubmap, BeginsNoneWhereThatIsSwitchedOff) {
  TrackingOptions options = BeginAfterAQuarter();
  options.submap.enabled = false;
  TrackingRun run(DefaultWorld(), options);
  Begin(run);
  Leave(run);
  EXPECT_EQ(run.map().FindSubmap(run.map().latest_keyframe()), SubmapId(0));
}

TEST_F(TrackerSubmap, ACoveredCameraBeginsNone) {
  TrackingRun run(DefaultWorld(), BeginAfterAQuarter());
  Begin(run);
  for (std::uint32_t i = 5; i < 20; ++i) {
    EXPECT_FALSE(run.Step(test::MakeBlindFrame(run.world().Frame(i))).keyframe);
  }
  EXPECT_FALSE(run.Step(elsewhere_.Frame(20)).keyframe) << "the time counts from here";
  const MadeFrame back = run.world().Frame(21);
  EXPECT_EQ(run.Step(back).status, TrackingStatus::kRelocalized);
}

TEST_F(TrackerSubmap, WaitsForMapping) {
  TrackingRun run(DefaultWorld(), BeginAfterAQuarter());
  Begin(run);
  for (std::uint32_t i = 5; i < 15; ++i) {
    const auto busy = [](TrackingInput& input) { input.keyframes_waiting = 1; };
    EXPECT_FALSE(run.Step(elsewhere_.Frame(i), busy).keyframe);
  }
  EXPECT_TRUE(run.Step(elsewhere_.Frame(15)).keyframe);
}

TEST_F(TrackerSubmap, FindsTheFirstOneAgainAndMixesNothing) {
  TrackingRun run(DefaultWorld(), BeginAfterAQuarter());
  Begin(run);
  const RigidTransform old_first = run.world().Frame(0).camera_from_world;
  std::uint32_t i = Leave(run);
  for (const std::uint32_t end = i + 4; i < end; ++i) run.Step(elsewhere_.Frame(i));
  int found = 0;
  for (std::uint32_t back = 2; back < 8; ++back, ++i) {
    MadeFrame frame = run.world().Frame(back);
    frame.id = FrameId(i);
    frame.stamp_ns = elsewhere_.Frame(i).stamp_ns;
    const TrackingResult result = run.Step(frame);
    if (result.status == TrackingStatus::kReckoned) continue;
    ++found;
    ASSERT_TRUE(HasPose(result.status)) << back;
    ExpectPose(result.camera_from_world, frame.camera_from_world * old_first.Inverse(), 1e-3, 0.1);
    EXPECT_EQ(run.map().FindSubmap(result.reference), SubmapId(0));
    EXPECT_EQ(SubmapsOf(run.map(), result), std::set{SubmapId(0)});
  }
  EXPECT_GE(found, 5);
  EXPECT_EQ(test::FindProblem(run.map()), "");
}

TEST_F(TrackerSubmap, TheNewestKeyframeOfAnotherOneIsNoPlaceToLookAt) {
  TrackingRun run;
  Begin(run);
  // A sub-map that has all that the camera is about to see, where its world happens to agree.
  const MadeFrame next = run.world().Frame(5);
  Keyframe apart = test::MakeTestKeyframe(next.features, run.Truth(next));
  apart.submap = SubmapId();
  test::AddWithDepth(run.map(), run.world().model(), apart);
  for (std::uint32_t i = 5; i < 8; ++i) {
    const TrackingResult result = run.Step(i);
    EXPECT_EQ(result.status, TrackingStatus::kTracked);
    EXPECT_EQ(SubmapsOf(run.map(), result), std::set{SubmapId(0)});
  }
  EXPECT_EQ(test::FindProblem(run.map()), "");
}

}  // namespace
}  // namespace ofm
