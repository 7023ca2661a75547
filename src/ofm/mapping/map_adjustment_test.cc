#include "ofm/mapping/map_adjustment.h"

#include <gtest/gtest.h>

#include "ofm/estimation/test_world.h"
#include "ofm/mapping/test_mapping.h"

namespace ofm {
namespace {

using test::Association;
using test::FindProblem;
using test::MadeFrame;
using test::TrueMap;

/// Six keyframes; `disturb` moves all but the first, and all landmarks.
class MapAdjustment : public testing::Test {
 protected:
  MapAdjustment() {
    for (std::uint32_t i = 0; i < 6; ++i) made_.Add(made_.world.Frame(4 * i));
    made_.RefreshAll();
  }

  void Disturb() {
    RandomEngine engine = MakeRandomEngine(4, 0);
    for (std::uint32_t i = 1; i < 6; ++i) {
      const RigidTransform error = ExpSe3(test::RandomTwist(engine, 0.01, 0.005));
      made_.map.SetKeyframePose(KeyframeId(i), error * Pose(i));
    }
    for (const auto& [shown, id] : made_.association.names()) {
      const Eigen::Vector3d error = test::RandomTwist(engine, 0.01, 0).head<3>();
      made_.map.SetLandmarkPosition(id, made_.map.GetLandmark(id).position_in_world + error);
    }
  }
  RigidTransform Pose(std::uint32_t i) const {
    return made_.map.GetKeyframe(KeyframeId(i)).camera_from_world;
  }
  double Error_m(std::uint32_t i) const {
    return test::DistanceOfCentres_m(Pose(i), made_.truth[i]);
  }
  bool IsAtTruth(std::uint32_t i) const {
    return test::MaxDifference(Pose(i), made_.truth[i]) == 0;
  }

  TrueMap made_;
  MappingOptions options_;
};

TEST_F(MapAdjustment, WholeMapComesBackToTheTruth) {
  Disturb();
  ASSERT_GT(made_.PoseError_m(), 0.01);
  ASSERT_GT(made_.PointError_m(), 0.01);
  AdjustWholeMap(made_.map, made_.world.model(), options_);
  EXPECT_LT(made_.PoseError_m(), 1e-3);
  EXPECT_LT(made_.PointError_m(), 2e-3);
  EXPECT_TRUE(IsAtTruth(0)) << "the first is fixed, to the last bit";
  EXPECT_EQ(FindProblem(made_.map), "");
}

TEST_F(MapAdjustment, LandmarksAreRefreshed) {
  Disturb();
  AdjustWholeMap(made_.map, made_.world.model(), options_);
  made_.map.landmarks().ForEach([&](const Landmark& landmark) {
    const Landmark::Observation& first = landmark.observations.front();
    const Keyframe& keyframe = made_.map.GetKeyframe(first.keyframe);
    const int octave = keyframe.features->keypoints[first.feature].octave;
    const double distance = (landmark.position_in_world - keyframe.CenterInWorld()).norm();
    EXPECT_NEAR(landmark.max_distance_m, distance * test::TestScales().Scale(octave), 1e-4);
  });
}

TEST_F(MapAdjustment, WrongObservationsLeaveTheMap) {
  const Keyframe last = made_.map.GetKeyframe(KeyframeId(5));
  const auto observers = [&](std::size_t feature) {
    return made_.map.GetLandmark(last.landmarks[feature]).observations.size();
  };
  std::size_t right = 0, wrong = 0;
  while (observers(right) < 3) ++right;
  while ((last.features->ideal_px[wrong] - last.features->ideal_px[right]).norm() < 50) ++wrong;
  const LandmarkId id = last.landmarks[right];
  const std::size_t before = observers(right);
  // Keyframe 5 is told that another of its features shows the landmark.
  made_.map.RemoveObservation(id, last.id);
  made_.map.RemoveObservation(last.landmarks[wrong], last.id);
  made_.map.AddObservation(id, last.id, static_cast<int>(wrong));
  AdjustWholeMap(made_.map, made_.world.model(), options_);
  ASSERT_NE(made_.map.FindLandmark(id), nullptr);
  EXPECT_EQ(made_.map.GetLandmark(id).FeatureIn(last.id), -1);
  EXPECT_EQ(made_.map.GetLandmark(id).observations.size(), before - 1);
  EXPECT_LT(made_.PoseError_m(), 1e-3);
  EXPECT_EQ(FindProblem(made_.map), "");
}

TEST_F(MapAdjustment, LocalOneMovesTheNeighbourhoodOnly) {
  Disturb();
  for (std::uint32_t i = 0; i < 5; ++i) made_.map.SetKeyframePose(KeyframeId(i), made_.truth[i]);
  ASSERT_GT(Error_m(5), 5e-3);
  options_.max_bundle_keyframes = 2;
  AdjustLocally(made_.map, KeyframeId(5), made_.world.model(), options_);
  EXPECT_LT(Error_m(5), 1e-3);
  int moved = 0;
  for (std::uint32_t i = 0; i < 5; ++i) moved += !IsAtTruth(i);
  EXPECT_LE(moved, 1) << "one neighbour at most";
  EXPECT_EQ(FindProblem(made_.map), "");
}

TEST_F(MapAdjustment, LocalOneAroundTheFirstKeyframeLeavesThatFixed) {
  Disturb();
  AdjustLocally(made_.map, KeyframeId(5), made_.world.model(), options_);
  EXPECT_TRUE(IsAtTruth(0));
  EXPECT_LT(made_.PoseError_m(), 1e-3);
}

TEST_F(MapAdjustment, EachSubmapIsHeldByItsOldestKeyframe) {
  const std::size_t apart = made_.map.keyframes().size();
  Association known;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const MadeFrame frame = made_.world.Frame(4 * i);
    Keyframe keyframe = test::MakeTestKeyframe(frame.features, frame.camera_from_world);
    keyframe.submap = i == 0 ? SubmapId() : SubmapId(static_cast<std::uint32_t>(apart));
    keyframe.landmarks = known.Names(made_.map, frame);
    const KeyframeId id = test::AddWithDepth(made_.map, made_.world.model(), keyframe);
    known.Learn(made_.map.GetKeyframe(id), frame);
    made_.truth.push_back(frame.camera_from_world);
  }
  Disturb();
  const auto begun = static_cast<std::uint32_t>(apart);
  made_.map.SetKeyframePose(KeyframeId(begun + 1), test::CameraAt(0.01, 0, 0) * Pose(begun + 1));
  AdjustWholeMap(made_.map, made_.world.model(), options_);
  EXPECT_TRUE(IsAtTruth(0));
  EXPECT_TRUE(IsAtTruth(begun));
  EXPECT_LT(made_.PoseError_m(), 1e-3);
  EXPECT_EQ(FindProblem(made_.map), "");
}

TEST_F(MapAdjustment, AloneKeyframeStaysWhereItIs) {
  TrueMap alone;
  alone.Add(alone.world.Frame(3));
  AdjustLocally(alone.map, KeyframeId(0), alone.world.model(), options_);
  AdjustWholeMap(alone.map, alone.world.model(), options_);
  EXPECT_EQ(alone.PoseError_m(), 0);
  EXPECT_EQ(FindProblem(alone.map), "");
}

TEST_F(MapAdjustment, EmptyMapStaysEmpty) {
  Map empty(test::TestScales());
  AdjustWholeMap(empty, made_.world.model(), options_);
  EXPECT_EQ(empty.keyframes().size(), 0U);
}

TEST_F(MapAdjustment, OfASnapshotHoldsForTheMapThatWentOn) {
  Disturb();
  const auto snapshot = made_.map.Snapshot();
  made_.Add(made_.world.Frame(30));
  made_.map.RemoveKeyframe(KeyframeId(3), KeyframeId(2));
  const auto correction =
      ComputeWholeAdjustment(*snapshot, made_.world.model(), options_.final_bundle);
  ASSERT_TRUE(correction);
  ApplyCorrection(*correction, made_.map);
  for (const std::uint32_t i : {1, 2, 4, 5}) EXPECT_LT(Error_m(i), 2e-3) << i;
  EXPECT_EQ(FindProblem(made_.map), "");
}

TEST_F(MapAdjustment, StoppedOneChangesNothing) {
  Disturb();
  const double before = made_.PoseError_m();
  std::stop_source source;
  source.request_stop();
  AdjustWholeMap(made_.map, made_.world.model(), options_, source.get_token());
  AdjustLocally(made_.map, KeyframeId(5), made_.world.model(), options_, source.get_token());
  EXPECT_FALSE(
      ComputeWholeAdjustment(*made_.map.Snapshot(), made_.world.model(), {}, source.get_token()));
  EXPECT_EQ(made_.PoseError_m(), before);
}

/// A map of which every other landmark was a pixel and a half to the right in keyframe 3.
TrueMap MapWithMovingLandmarks() {
  TrueMap made;
  for (std::uint32_t i = 0; i < 6; ++i) {
    const MadeFrame frame = made.world.Frame(4 * i);
    made.Add(i != 3 ? frame : test::Changed(frame, [&](FrameFeatures& features) {
      for (std::size_t k = 0; k < features.size(); ++k) {
        if (frame.shown[k].value % 2 == 0) features.ideal_px[k].x() += 1.5F;
      }
    }));
  }
  made.RefreshAll();
  return made;
}

TEST(MapAdjustmentWeights, LandmarksThatMayMoveCountLess) {
  TrueMap plain = MapWithMovingLandmarks(), weighted = MapWithMovingLandmarks();
  for (const auto& [shown, id] : weighted.association.names()) {
    for (int i = 0; i < 40 && shown.value % 2 == 0; ++i) {
      weighted.map.UpdateStaticProbability(id, 0);
    }
  }
  const auto error_m = [](TrueMap& made) {
    AdjustWholeMap(made.map, made.world.model(), {});
    return test::DistanceOfCentres_m(made.map.GetKeyframe(KeyframeId(3)).camera_from_world,
                                     made.truth[3]);
  };
  const double without = error_m(plain), with = error_m(weighted);
  EXPECT_GT(without, 5e-4);
  EXPECT_LT(with, 0.3 * without);
}

TEST(MapAdjustmentWeights, FeaturesThatMayMoveCountLess) {
  const auto error_m = [](float probability) {
    TrueMap made;
    for (std::uint32_t i = 0; i < 6; ++i) {
      const MadeFrame frame = made.world.Frame(4 * i);
      made.Add(i != 3 ? frame : test::Changed(frame, [&](FrameFeatures& features) {
        features.static_probability.assign(features.size(), 1.0F);
        for (std::size_t k = 0; k < features.size(); ++k) {
          if (frame.shown[k].value % 2 != 0) continue;
          features.ideal_px[k].x() += 1.5F;
          features.static_probability[k] = probability;
        }
      }));
    }
    made.RefreshAll();
    AdjustWholeMap(made.map, made.world.model(), {});
    return test::DistanceOfCentres_m(made.map.GetKeyframe(KeyframeId(3)).camera_from_world,
                                     made.truth[3]);
  };
  const double without = error_m(1), with = error_m(0.01F);
  EXPECT_GT(without, 5e-4);
  EXPECT_LT(with, 0.3 * without);
}

}  // namespace
}  // namespace ofm
