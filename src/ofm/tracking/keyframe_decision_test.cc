#include "ofm/tracking/keyframe_decision.h"

#include <gtest/gtest.h>

#include "ofm/map/test_map.h"

namespace ofm {
namespace {

using test::MakePlainKeyframe;
using test::MakeTestFeatures;

// What calls for no keyframe, with options that do not depend on the defaults.
KeyframeOptions MakeOptions() {
  KeyframeOptions options;
  options.inlier_ratio = 0.75;
  options.max_frames = 30;
  options.min_inliers = 15;
  options.close_tracked = 100;
  options.close_untracked = 70;
  options.max_waiting = 3;
  return options;
}

KeyframeEvidence MakeQuietEvidence() {
  KeyframeEvidence evidence;
  evidence.frames_since_keyframe = 5;
  evidence.inliers = 200;
  evidence.reference_landmarks = 200;
  evidence.close_tracked = 200;
  return evidence;
}

bool Needs(const KeyframeEvidence& evidence) { return NeedsKeyframe(evidence, MakeOptions()); }

TEST(KeyframeDecision, WellTrackedFrameMakesNone) { EXPECT_FALSE(Needs(MakeQuietEvidence())); }

TEST(KeyframeDecision, FewerInliersThanAShareOfTheReferencesCallForOne) {
  KeyframeEvidence evidence = MakeQuietEvidence();
  evidence.inliers = 150;
  EXPECT_FALSE(Needs(evidence));
  evidence.inliers = 149;
  EXPECT_TRUE(Needs(evidence));
}

TEST(KeyframeDecision, FewTrackedClosePointsCallForOneOnlyWhereMoreAreToBeHad) {
  KeyframeEvidence evidence = MakeQuietEvidence();
  evidence.close_tracked = 99;
  EXPECT_FALSE(Needs(evidence));
  evidence.close_untracked = 70;
  EXPECT_FALSE(Needs(evidence));
  evidence.close_untracked = 71;
  EXPECT_TRUE(Needs(evidence));
  evidence.close_tracked = 100;
  EXPECT_FALSE(Needs(evidence));
}

TEST(KeyframeDecision, ManyFramesSinceTheLastCallForOne) {
  KeyframeEvidence evidence = MakeQuietEvidence();
  evidence.frames_since_keyframe = 29;
  EXPECT_FALSE(Needs(evidence));
  evidence.frames_since_keyframe = 30;
  EXPECT_TRUE(Needs(evidence));
}

TEST(KeyframeDecision, TooFewInliersMakeNoneWhateverCallsForIt) {
  KeyframeEvidence evidence = MakeQuietEvidence();
  evidence.frames_since_keyframe = 100;
  evidence.inliers = 15;
  EXPECT_TRUE(Needs(evidence));
  evidence.inliers = 14;
  EXPECT_FALSE(Needs(evidence));
}

TEST(KeyframeDecision, NoneIsMadeWhileMappingIsTooFarBehind) {
  KeyframeEvidence evidence = MakeQuietEvidence();
  evidence.frames_since_keyframe = 100;
  evidence.keyframes_waiting = 2;
  EXPECT_TRUE(Needs(evidence));
  evidence.keyframes_waiting = 3;
  EXPECT_FALSE(Needs(evidence));
}

/// Two keyframes of ten features; landmarks 0 to 3 are seen by both, 4 to 7 by the first alone.
Map MakeMap() {
  Map map(test::TestScales());
  map.AddKeyframe(MakePlainKeyframe(10));
  for (int i = 0; i < 8; ++i) map.AddLandmark({0, 0, 2}, KeyframeId(0), i);
  Keyframe second = MakePlainKeyframe(10);
  for (int i = 0; i < 4; ++i) second.landmarks[i] = LandmarkId(i);
  map.AddKeyframe(std::move(second));
  return map;
}

TEST(KeyframeEvidence, CountsLandmarksWithEnoughObservers) {
  Map map = MakeMap();
  const auto snapshot = map.Snapshot();
  const Keyframe& first = *snapshot->keyframes.Find(KeyframeId(0));
  EXPECT_EQ(CountWellObserved(*snapshot, first, 1), 8);
  EXPECT_EQ(CountWellObserved(*snapshot, first, 2), 4);
  EXPECT_EQ(CountWellObserved(*snapshot, first, 3), 0);
}

/// A frame of six features at 0.5, 1, ... m (close: up to 3 m), the last one without depth.
TrackingInput MakeInput(std::shared_ptr<const MapSnapshot> map) {
  std::vector<test::TestFeature> features;
  for (const float depth : {1.0F, 2.0F, 2.5F, 3.5F, 4.0F, 0.0F}) {
    features.push_back({{320, 240}, depth, 0, {}, 0});
  }
  TrackingInput input;
  input.frame_id = FrameId(12);
  input.features = MakeTestFeatures(features);
  input.map = std::move(map);
  input.keyframes_waiting = 2;
  return input;
}

TrackingResult MakeResult() {
  TrackingResult result;
  result.reference = KeyframeId(0);
  result.inliers = 77;
  result.landmarks.resize(6);
  for (const int feature : {0, 3, 5}) result.landmarks[feature] = LandmarkId(feature);
  return result;
}

MeasurementModel MakeModel() {
  MeasurementModel model{PinholeCamera(), test::TestScales(), {}};
  model.camera.baseline_m = 0.075;
  model.options.close_baselines = 40;
  return model;
}

TEST(KeyframeEvidence, IsGatheredFromTheFrame) {
  Map map = MakeMap();
  const KeyframeEvidence evidence =
      GatherKeyframeEvidence(MakeModel(), MakeInput(map.Snapshot()), MakeResult(), FrameId(5));
  EXPECT_EQ(evidence.frames_since_keyframe, 7);
  EXPECT_EQ(evidence.inliers, 77);
  EXPECT_EQ(evidence.keyframes_waiting, 2);
  EXPECT_EQ(evidence.close_tracked, 1) << "far features and those without depth do not count";
  EXPECT_EQ(evidence.close_untracked, 2);
}

TEST(KeyframeEvidence, AsksForTwoObserversOnceThereAreThreeKeyframes) {
  Map map = MakeMap();
  const auto reference_landmarks = [&] {
    return GatherKeyframeEvidence(MakeModel(), MakeInput(map.Snapshot()), MakeResult(), FrameId(5))
        .reference_landmarks;
  };
  EXPECT_EQ(reference_landmarks(), 8);
  map.AddKeyframe(MakePlainKeyframe(10));
  EXPECT_EQ(reference_landmarks(), 4);
}

TEST(KeyframeEvidence, HasNoReferenceLandmarksWithoutReference) {
  Map map = MakeMap();
  TrackingResult result = MakeResult();
  result.reference = KeyframeId();
  const KeyframeEvidence evidence =
      GatherKeyframeEvidence(MakeModel(), MakeInput(map.Snapshot()), result, FrameId(5));
  EXPECT_EQ(evidence.reference_landmarks, 0);
}

}  // namespace
}  // namespace ofm
