#include "ofm/map/map.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "ofm/map/test_map.h"

namespace ofm {
namespace {

using test::CameraAt;
using test::FindProblem;
using test::MakePlainKeyframe;
using test::MaxDifference;

const Eigen::Vector3d kPoint(0, 0, 2);

/// A map of `keyframes` plain keyframes, 0.1 m apart, with eight features each.
Map MakeMap(int keyframes) {
  Map map(test::TestScales());
  for (int i = 0; i < keyframes; ++i)
    map.AddKeyframe(MakePlainKeyframe(8, CameraAt(0.1 * i, 0, 0)));
  return map;
}

/// A landmark that feature `feature` of the keyframes 0 to `observers` - 1 shows.
LandmarkId AddSeen(Map& map, int observers, int feature) {
  const LandmarkId id = map.AddLandmark(kPoint, KeyframeId(0), feature);
  for (int i = 1; i < observers; ++i) map.AddObservation(id, KeyframeId(i), feature);
  return id;
}

TEST(Map, NewLandmarkIsSeenByTheFeatureThatMadeIt) {
  Map map = MakeMap(1);
  const LandmarkId id = map.AddLandmark(kPoint, KeyframeId(0), 3);
  EXPECT_EQ(map.GetKeyframe(KeyframeId(0)).landmarks[3], id);
  const Landmark& landmark = map.GetLandmark(id);
  EXPECT_EQ(landmark.FeatureIn(KeyframeId(0)), 3);
  EXPECT_EQ(landmark.FeatureIn(KeyframeId(1)), -1);
  EXPECT_EQ(landmark.first_keyframe, KeyframeId(0));
  EXPECT_EQ(landmark.position_in_world, kPoint);
  EXPECT_EQ(FindProblem(map), "");
}

TEST(Map, KeyframeBecomesAnObserverOfTheLandmarksItNames) {
  Map map = MakeMap(1);
  const LandmarkId id = map.AddLandmark(kPoint, KeyframeId(0), 3);
  Keyframe keyframe = MakePlainKeyframe(8);
  keyframe.landmarks[5] = id;
  const KeyframeId added = map.AddKeyframe(keyframe);
  EXPECT_EQ(added, KeyframeId(1));
  EXPECT_EQ(map.latest_keyframe(), added);
  EXPECT_EQ(map.GetLandmark(id).FeatureIn(added), 5);
  EXPECT_EQ(FindProblem(map), "");
}

TEST(Map, KeyframesNamesThatAreGoneOrComeTwiceAreDropped) {
  Map map = MakeMap(1);
  const LandmarkId kept = AddSeen(map, 1, 0), gone = AddSeen(map, 1, 1);
  map.RemoveLandmark(gone);
  Keyframe keyframe = MakePlainKeyframe(8);
  keyframe.landmarks[2] = kept;
  keyframe.landmarks[3] = kept;
  keyframe.landmarks[4] = gone;
  keyframe.landmarks[5] = LandmarkId(77);
  const Keyframe& added = map.GetKeyframe(map.AddKeyframe(keyframe));
  EXPECT_EQ(added.landmarks[2], kept);
  for (const int feature : {3, 4, 5}) EXPECT_FALSE(added.landmarks[feature].valid());
  EXPECT_EQ(FindProblem(map), "");
}

TEST(Map, KeyframesNamesFollowFusions) {
  Map map = MakeMap(1);
  const LandmarkId from = AddSeen(map, 1, 0), into = AddSeen(map, 1, 1);
  map.Fuse(from, into);
  Keyframe keyframe = MakePlainKeyframe(8);
  keyframe.landmarks[2] = from;
  keyframe.landmarks[3] = into;
  const Keyframe& added = map.GetKeyframe(map.AddKeyframe(keyframe));
  EXPECT_EQ(added.landmarks[2], into);
  EXPECT_FALSE(added.landmarks[3].valid()) << "the same landmark a second time";
  EXPECT_EQ(FindProblem(map), "");
}

TEST(Map, RefusesAKeyframeWithoutFeaturesOrWithAListOfAnotherSize) {
  Map map = MakeMap(0);
  EXPECT_THROW(map.AddKeyframe({}), std::logic_error);
  Keyframe keyframe = MakePlainKeyframe(8);
  keyframe.landmarks.pop_back();
  EXPECT_THROW(map.AddKeyframe(keyframe), std::logic_error);
  EXPECT_EQ(map.keyframes().size(), 0U);
}

TEST(Map, ObservationsAreByIncreasingKeyframe) {
  Map map = MakeMap(4);
  const LandmarkId id = map.AddLandmark(kPoint, KeyframeId(2), 0);
  for (const int keyframe : {3, 0, 1}) map.AddObservation(id, KeyframeId(keyframe), 0);
  std::vector<std::uint32_t> order;
  for (const auto& o : map.GetLandmark(id).observations) order.push_back(o.keyframe.value);
  EXPECT_EQ(order, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(FindProblem(map), "");
}

TEST(Map, RefusesATakenFeatureAndASecondSightOfALandmark) {
  Map map = MakeMap(2);
  const LandmarkId a = AddSeen(map, 2, 0), b = AddSeen(map, 1, 1);
  EXPECT_THROW(map.AddObservation(b, KeyframeId(1), 0), std::logic_error);
  EXPECT_THROW(map.AddObservation(a, KeyframeId(1), 4), std::logic_error);
  EXPECT_EQ(FindProblem(map), "") << "a refusal leaves the map as it was";
}

TEST(Map, LandmarkGoesWithItsLastObservation) {
  Map map = MakeMap(2);
  const LandmarkId id = AddSeen(map, 2, 0);
  map.RemoveObservation(id, KeyframeId(0));
  ASSERT_NE(map.FindLandmark(id), nullptr);
  EXPECT_FALSE(map.GetKeyframe(KeyframeId(0)).landmarks[0].valid());
  EXPECT_THROW(map.RemoveObservation(id, KeyframeId(0)), std::logic_error);
  map.RemoveObservation(id, KeyframeId(1));
  EXPECT_EQ(map.FindLandmark(id), nullptr);
  EXPECT_EQ(FindProblem(map), "");
}

TEST(Map, RemovedLandmarkFreesTheFeaturesThatShowedIt) {
  Map map = MakeMap(3);
  const LandmarkId id = AddSeen(map, 3, 2);
  map.RemoveLandmark(id);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(map.GetKeyframe(KeyframeId(i)).landmarks[2].valid());
  }
  EXPECT_EQ(map.landmarks().size(), 0U);
  EXPECT_EQ(FindProblem(map), "");
}

TEST(Map, RemovedKeyframeTakesAlongWhatItAloneSaw) {
  Map map = MakeMap(2);
  const LandmarkId shared = AddSeen(map, 2, 0);
  const LandmarkId own = map.AddLandmark(kPoint, KeyframeId(1), 1);
  map.RemoveKeyframe(KeyframeId(1), KeyframeId(0));
  EXPECT_EQ(map.FindKeyframe(KeyframeId(1)), nullptr);
  EXPECT_EQ(map.FindLandmark(own), nullptr);
  ASSERT_NE(map.FindLandmark(shared), nullptr);
  EXPECT_EQ(map.GetLandmark(shared).observations.size(), 1U);
  EXPECT_EQ(FindProblem(map), "");
}

TEST(Map, RemovedKeyframeKeepsItsPoseAndFollowsItsAnchor) {
  Map map = MakeMap(3);
  const RigidTransform pose = map.GetKeyframe(KeyframeId(1)).camera_from_world;
  map.RemoveKeyframe(KeyframeId(1), KeyframeId(2));
  EXPECT_LT(MaxDifference(*map.Snapshot()->FindKeyframePose(KeyframeId(1)), pose), 1e-12);

  // The anchor turns to the left about the world's origin: the removed one goes with it.
  const RigidTransform turned(ExpSo3({0, 0.5, 0}), {1, 2, 3});
  map.SetKeyframePose(KeyframeId(2),
                      map.GetKeyframe(KeyframeId(2)).camera_from_world * turned.Inverse());
  EXPECT_LT(
      MaxDifference(*map.Snapshot()->FindKeyframePose(KeyframeId(1)), pose * turned.Inverse()),
      1e-12);
}

TEST(Map, PoseIsFoundThroughAChainOfAnchors) {
  Map map = MakeMap(4);
  const RigidTransform first = map.GetKeyframe(KeyframeId(1)).camera_from_world;
  map.RemoveKeyframe(KeyframeId(1), KeyframeId(2));
  const RigidTransform turned(ExpSo3({0, 0, 0.3}), {0, 0, 1});
  map.SetKeyframePose(KeyframeId(2), map.GetKeyframe(KeyframeId(2)).camera_from_world * turned);
  map.RemoveKeyframe(KeyframeId(2), KeyframeId(3));
  EXPECT_LT(MaxDifference(*map.Snapshot()->FindKeyframePose(KeyframeId(1)), first * turned), 1e-12);
  EXPECT_LT(MaxDifference(*map.FindKeyframePose(KeyframeId(1)), first * turned), 1e-12);
}

TEST(Map, PoseOfAKeyframeThatNeverWasIsEmpty) {
  Map map = MakeMap(1);
  EXPECT_FALSE(map.Snapshot()->FindKeyframePose(KeyframeId(5)).has_value());
  EXPECT_FALSE(map.Snapshot()->FindKeyframePose(KeyframeId()).has_value());
}

TEST(Map, RefusesAnAnchorThatIsGoneOrTheKeyframeItself) {
  Map map = MakeMap(3);
  map.RemoveKeyframe(KeyframeId(2), KeyframeId(1));
  EXPECT_THROW(map.RemoveKeyframe(KeyframeId(1), KeyframeId(1)), std::logic_error);
  EXPECT_THROW(map.RemoveKeyframe(KeyframeId(1), KeyframeId(2)), std::logic_error);
  EXPECT_NE(map.FindKeyframe(KeyframeId(1)), nullptr);
}

TEST(Map, SnapshotIsWhatTheMapWasWhenItWasTaken) {
  Map map = MakeMap(2);
  const LandmarkId a = AddSeen(map, 2, 0), b = AddSeen(map, 2, 1);
  const auto before = map.Snapshot();
  map.Fuse(a, b);
  map.SetLandmarkPosition(b, {9, 9, 9});
  map.SetKeyframePose(KeyframeId(0), CameraAt(5, 5, 5));
  map.RemoveKeyframe(KeyframeId(1), KeyframeId(0));
  map.AddKeyframe(MakePlainKeyframe(8));

  EXPECT_EQ(FindProblem(*before), "");
  EXPECT_EQ(before->FindLandmark(a)->id, a);
  EXPECT_EQ(before->FindLandmark(b)->position_in_world, kPoint);
  EXPECT_EQ(before->latest_keyframe, KeyframeId(1));
  EXPECT_EQ(before->keyframe_count, 2U);
  EXPECT_TRUE(before->anchors.empty());
  EXPECT_LT(MaxDifference(*before->FindKeyframePose(KeyframeId(0)), CameraAt(0, 0, 0)), 1e-12);

  const auto after = map.Snapshot();
  EXPECT_EQ(FindProblem(*after), "");
  EXPECT_EQ(after->FindLandmark(a)->id, b);
  EXPECT_EQ(after->latest_keyframe, KeyframeId(2));
  EXPECT_EQ(after->landmark_count, 1U);
}

TEST(Map, GoesOnFromASnapshotUnderTheSameIds) {
  Map map = MakeMap(3);
  const LandmarkId a = AddSeen(map, 3, 0), b = AddSeen(map, 3, 1);
  map.Fuse(a, b);
  map.RemoveKeyframe(KeyframeId(2), KeyframeId(0));
  const auto snapshot = map.Snapshot();

  Map second(test::TestScales(), *snapshot);
  EXPECT_EQ(test::FindDifference(*second.Snapshot(), *snapshot), "");
  EXPECT_EQ(second.FindLandmark(a)->id, b);
  EXPECT_EQ(second.keyframes().size(), 2U);
  EXPECT_EQ(second.AddKeyframe(MakePlainKeyframe(8)), KeyframeId(3));
  EXPECT_EQ(second.AddLandmark(kPoint, KeyframeId(3), 0), LandmarkId(2));
  second.SetLandmarkPosition(b, {9, 9, 9});
  EXPECT_EQ(FindProblem(second), "");
  EXPECT_EQ(snapshot->FindLandmark(b)->position_in_world, kPoint) << "it has not changed";
  EXPECT_EQ(map.FindLandmark(b)->position_in_world, kPoint) << "nor has the first map";
}

}  // namespace
}  // namespace ofm
