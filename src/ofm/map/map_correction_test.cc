#include "ofm/map/map_correction.h"

#include <gtest/gtest.h>

#include "ofm/map/test_map.h"

namespace ofm {
namespace {

using test::CameraAt;
using test::MaxDifference;

/// Two keyframes a metre apart, each with a landmark of its own and one that both see.
struct SmallMap {
  SmallMap() {
    first = map.AddKeyframe(test::MakePlainKeyframe(8, CameraAt(0, 0, 0)));
    second = map.AddKeyframe(test::MakePlainKeyframe(8, CameraAt(1, 0, 0)));
    of_first = map.AddLandmark({0, 0, 2}, first, 0);
    of_second = map.AddLandmark({1, 0, 2}, second, 0);
    shared = map.AddLandmark({0.5, 0, 2}, first, 1);
    map.AddObservation(shared, second, 1);
  }
  /// Moves the second keyframe half a metre up; the first one stays.
  MapCorrection LiftSecond() const {
    MapCorrection correction;
    for (const KeyframeId id : {first, second}) {
      const RigidTransform& pose = map.GetKeyframe(id).camera_from_world;
      correction.keyframes[id] = {pose, pose};
    }
    correction.keyframes[second].after = CameraAt(1, 0.5, 0);
    return correction;
  }
  Eigen::Vector3d Position(LandmarkId id) const { return map.GetLandmark(id).position_in_world; }

  Map map{test::TestScales()};
  KeyframeId first, second;
  LandmarkId of_first, of_second, shared;
};

TEST(MapCorrection, LandmarksMoveWithTheKeyframeThatMadeThem) {
  SmallMap small;
  ApplyCorrection(small.LiftSecond(), small.map);
  EXPECT_LT(
      MaxDifference(small.map.GetKeyframe(small.second).camera_from_world, CameraAt(1, 0.5, 0)),
      1e-12);
  EXPECT_EQ(small.Position(small.of_first), Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(small.Position(small.shared), Eigen::Vector3d(0.5, 0, 2));
  EXPECT_LT((small.Position(small.of_second) - Eigen::Vector3d(1, 0.5, 2)).norm(), 1e-12);
  EXPECT_EQ(test::FindProblem(small.map), "");
}

TEST(MapCorrection, ALandmarkWhoseMakerIsGoneMovesWithAnObserver) {
  SmallMap small;
  MapCorrection correction = small.LiftSecond();
  correction.keyframes.erase(small.first);
  small.map.RemoveKeyframe(small.first, small.second);
  ApplyCorrection(correction, small.map);
  EXPECT_LT((small.Position(small.shared) - Eigen::Vector3d(0.5, 0.5, 2)).norm(), 1e-12);
}

TEST(MapCorrection, WhatWasAddedMeanwhileMovesWithItsNeighbour) {
  SmallMap small;
  const MapCorrection correction = small.LiftSecond();
  Keyframe later = test::MakePlainKeyframe(8, CameraAt(2, 0, 0));
  later.landmarks[3] = small.of_second;
  const KeyframeId third = small.map.AddKeyframe(std::move(later));
  const LandmarkId of_third = small.map.AddLandmark({2, 0, 2}, third, 0);
  // Sees nothing of the others: moves with the one before it.
  const KeyframeId fourth = small.map.AddKeyframe(test::MakePlainKeyframe(8, CameraAt(3, 0, 0)));
  ApplyCorrection(correction, small.map);
  EXPECT_LT(MaxDifference(small.map.GetKeyframe(third).camera_from_world, CameraAt(2, 0.5, 0)),
            1e-12);
  EXPECT_LT((small.Position(of_third) - Eigen::Vector3d(2, 0.5, 2)).norm(), 1e-12);
  EXPECT_LT(MaxDifference(small.map.GetKeyframe(fourth).camera_from_world, CameraAt(3, 0.5, 0)),
            1e-12);
}

TEST(MapCorrection, AKeyframeMovedMeanwhileKeepsThatMotionToo) {
  SmallMap small;
  const MapCorrection correction = small.LiftSecond();
  small.map.SetKeyframePose(small.second, CameraAt(1.01, 0, 0));
  ApplyCorrection(correction, small.map);
  EXPECT_LT(
      MaxDifference(small.map.GetKeyframe(small.second).camera_from_world, CameraAt(1.01, 0.5, 0)),
      1e-12);
}

TEST(MapCorrection, NamedLandmarksGoWhereTheyAreToldUnlessTheyMovedMeanwhile) {
  SmallMap small;
  MapCorrection correction = small.LiftSecond();
  correction.landmarks[small.of_first] = {{0, 0, 2}, {0, 0, 2.25}};
  correction.landmarks[small.of_second] = {{1, 0, 2}, {7, 7, 7}};
  small.map.SetLandmarkPosition(small.of_second, {1, 0, 2.1});
  ApplyCorrection(correction, small.map);
  EXPECT_EQ(small.Position(small.of_first), Eigen::Vector3d(0, 0, 2.25));
  EXPECT_LT((small.Position(small.of_second) - Eigen::Vector3d(1, 0.5, 2.1)).norm(), 1e-12);
}

TEST(MapCorrection, WhatAFeatureShowedIsFusedIntoTheKnownLandmark) {
  SmallMap small;
  MapCorrection correction = small.LiftSecond();
  const LandmarkId extra = small.map.AddLandmark({0, 0, 3}, small.second, 6);
  correction.found = {{small.of_first, small.second, 6}, {small.shared, small.second, 0}};
  const CorrectionReport report = ApplyCorrection(correction, small.map);
  EXPECT_EQ(report.landmarks_fused, 1);
  EXPECT_EQ(small.map.FindLandmark(extra)->id, small.of_first);
  EXPECT_EQ(small.map.GetKeyframe(small.second).landmarks[6], small.of_first);
  EXPECT_NE(small.map.FindLandmark(small.of_second), nullptr)
      << "the second keyframe sees the shared one already";
  EXPECT_EQ(test::FindProblem(small.map), "");
}

TEST(MapCorrection, AFreeFeatureGainsAnObservation) {
  SmallMap small;
  MapCorrection correction = small.LiftSecond();
  correction.found = {{small.of_first, small.second, 5}};
  EXPECT_EQ(ApplyCorrection(correction, small.map).observations_added, 1);
  EXPECT_EQ(small.map.GetLandmark(small.of_first).FeatureIn(small.second), 5);
}

TEST(MapCorrection, TwoKnownLandmarksAreNeverFused) {
  SmallMap small;
  MapCorrection correction = small.LiftSecond();
  correction.found = {{small.of_first, small.second, 0}, {small.of_second, small.first, 4}};
  EXPECT_EQ(ApplyCorrection(correction, small.map).landmarks_fused, 0);
  EXPECT_NE(small.map.landmarks().Find(small.of_first), nullptr);
  EXPECT_NE(small.map.landmarks().Find(small.of_second), nullptr);
}

TEST(MapCorrection, WrongObservationsGoWhereTheyStillAre) {
  SmallMap small;
  MapCorrection correction = small.LiftSecond();
  correction.wrong = {{small.shared, small.second, 1},
                      {small.of_first, small.second, 0},
                      {small.of_second, small.second, 0}};
  EXPECT_EQ(ApplyCorrection(correction, small.map).observations_removed, 2);
  EXPECT_EQ(small.map.GetLandmark(small.shared).observations.size(), 1);
  EXPECT_EQ(small.map.FindLandmark(small.of_second), nullptr) << "it was the last one";
}

TEST(MapCorrection, WhatIsGoneIsIgnored) {
  SmallMap small;
  MapCorrection correction = small.LiftSecond();
  correction.landmarks[small.of_first] = {{0, 0, 2}, {0, 0, 3}};
  correction.found = {{small.of_first, small.second, 5}, {small.shared, small.first, 5}};
  correction.wrong = {{small.of_first, small.first, 0}};
  small.map.RemoveLandmark(small.of_first);
  small.map.RemoveKeyframe(small.first, small.second);
  const CorrectionReport report = ApplyCorrection(correction, small.map);
  EXPECT_EQ(report.observations_added + report.observations_removed + report.landmarks_fused, 0);
  EXPECT_EQ(test::FindProblem(small.map), "");
}

}  // namespace
}  // namespace ofm
