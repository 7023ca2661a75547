#include "ofm/mapping/keyframe_culling.h"

#include <gtest/gtest.h>

#include "ofm/mapping/test_mapping.h"

namespace ofm {
namespace {

using test::Changed;
using test::FindProblem;
using test::MadeFrame;
using test::TrueMap;

/// Keyframes that see the same, from places 1 mm apart as far as their poses tell.
TrueMap MakeAlike(std::uint32_t count, int coarser_octaves = 0) {
  TrueMap made;
  for (std::uint32_t i = 0; i < count; ++i) {
    const RigidTransform shift(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.001 * i, 0, 0));
    MadeFrame frame = made.world.Frame(0);
    frame.id = FrameId(i);
    frame.camera_from_world = shift * frame.camera_from_world;
    made.Add(Changed(frame, [&](FrameFeatures& features) {
      for (Keypoint& keypoint : features.keypoints) {
        keypoint.octave = i == 1 ? 0 : coarser_octaves;  // the second has finer ones
      }
    }));
  }
  return made;
}

std::vector<std::uint32_t> Left(const Map& map) {
  std::vector<std::uint32_t> ids;
  map.keyframes().ForEach([&](const Keyframe& keyframe) { ids.push_back(keyframe.id.value); });
  return ids;
}

TEST(KeyframeCulling, RemovesWhatThreeOthersSeeAsWell) {
  TrueMap made = MakeAlike(6);
  RemoveRedundantKeyframes(made.map, KeyframeId(5), made.world.model(), {});
  // One after another goes while three others are left; the first and the current one stay.
  EXPECT_EQ(Left(made.map), (std::vector<std::uint32_t>{0, 4, 5}));
  EXPECT_EQ(FindProblem(made.map), "");
}

TEST(KeyframeCulling, PosesOfRemovedKeyframesAreKept) {
  TrueMap made = MakeAlike(6);
  RemoveRedundantKeyframes(made.map, KeyframeId(5), made.world.model(), {});
  const auto snapshot = made.map.Snapshot();
  ASSERT_EQ(snapshot->anchors.size(), 3U);
  for (std::uint32_t i = 0; i < 6; ++i) {
    const auto pose = snapshot->FindKeyframePose(KeyframeId(i));
    ASSERT_TRUE(pose.has_value());
    EXPECT_LT(test::MaxDifference(*pose, made.truth[i]), 1e-9);
  }
}

TEST(KeyframeCulling, TwoOthersAreNotEnough) {
  TrueMap made = MakeAlike(3);
  RemoveRedundantKeyframes(made.map, KeyframeId(2), made.world.model(), {});
  EXPECT_EQ(made.map.keyframes().size(), 3U);
}

TEST(KeyframeCulling, OthersThatSeeItMuchCoarserDoNotCount) {
  TrueMap coarser = MakeAlike(5, 2);
  RemoveRedundantKeyframes(coarser.map, KeyframeId(4), coarser.world.model(), {});
  EXPECT_NE(coarser.map.FindKeyframe(KeyframeId(1)), nullptr) << "two octaves coarser";
  TrueMap alike = MakeAlike(5, 1);
  RemoveRedundantKeyframes(alike.map, KeyframeId(4), alike.world.model(), {});
  EXPECT_EQ(alike.map.FindKeyframe(KeyframeId(1)), nullptr) << "one octave coarser";
}

TEST(KeyframeCulling, ShareDecides) {
  for (const double share : {0.6, 0.9}) {
    TrueMap made = MakeAlike(5);
    // A quarter of what keyframe 1 sees is seen by nobody else.
    const std::vector<LandmarkId> seen = made.map.GetKeyframe(KeyframeId(1)).landmarks;
    for (std::size_t i = 0; i < seen.size(); i += 4) {
      for (const std::uint32_t other : {0U, 2U, 3U, 4U}) {
        made.map.RemoveObservation(seen[i], KeyframeId(other));
      }
    }
    MappingOptions options;
    options.redundant_share = share;
    RemoveRedundantKeyframes(made.map, KeyframeId(4), made.world.model(), options);
    EXPECT_EQ(made.map.FindKeyframe(KeyframeId(1)) == nullptr, share < 0.75) << share;
  }
}

TEST(KeyframeCulling, ViewsOfFarLandmarksAloneAreNotJudged) {
  TrueMap made = MakeAlike(6);
  MeasurementModel model = made.world.model();
  model.options.close_baselines = 0.1;
  RemoveRedundantKeyframes(made.map, KeyframeId(5), model, {});
  EXPECT_EQ(made.map.keyframes().size(), 6U);
}

TEST(KeyframeBudget, WithinItNothingGoes) {
  TrueMap made = MakeAlike(16);
  RemoveKeyframesOverBudget(made.map, KeyframeId(15), made.world.model(), {.max_keyframes = 16});
  EXPECT_EQ(made.map.keyframes().size(), 16U);
}

TEST(KeyframeBudget, WhatSharesLandmarksWithTheCurrentKeyframeStays) {
  TrueMap made = MakeAlike(17);
  RemoveKeyframesOverBudget(made.map, KeyframeId(16), made.world.model(), {.max_keyframes = 10});
  EXPECT_EQ(made.map.keyframes().size(), 17U);
}

/// A way along which each keyframe sees four groups of landmarks, one of them for the first time.
class KeyframesAlongAWay : public testing::Test {
 protected:
  static constexpr int kSeen = 4, kGroup = 20;

  explicit KeyframesAlongAWay(int keyframes = 40) {
    for (int k = 0; k < keyframes; ++k) {
      Keyframe keyframe = test::MakePlainKeyframe(kSeen * kGroup);
      for (int i = 0; i + kGroup < kSeen * kGroup && k > 0; ++i) {
        keyframe.landmarks[i] = map_.GetKeyframe(KeyframeId(k - 1)).landmarks[i + kGroup];
      }
      const KeyframeId id = map_.AddKeyframe(keyframe);
      for (int i = 0; i < kSeen * kGroup; ++i) {
        if (!map_.GetKeyframe(id).landmarks[i].valid()) map_.AddLandmark({0, 0, 2}, id, i);
      }
    }
  }

  void KeepTo(int max_keyframes) {
    RemoveKeyframesOverBudget(map_, map_.latest_keyframe(), model_,
                              {.max_keyframes = max_keyframes});
  }

  Map map_{test::TestScales()};
  MeasurementModel model_ = test::FeatureWorld(test::DefaultWorld()).model();
};

TEST_F(KeyframesAlongAWay, AreThinnedEvenlyToTheBudgetWithoutLosingAPlace) {
  const std::size_t landmarks = map_.landmarks().size();
  KeepTo(16);
  const std::vector<std::uint32_t> left = Left(map_);
  ASSERT_EQ(left.size(), 15U) << "a sixteenth fewer";
  EXPECT_EQ(left.front(), 0U) << "holds the world";
  for (std::size_t i = 1; i < left.size(); ++i) EXPECT_LE(left[i] - left[i - 1], 4U);
  EXPECT_EQ(map_.landmarks().size(), landmarks) << "each is still seen";
  EXPECT_EQ(FindProblem(map_), "");
}

TEST_F(KeyframesAlongAWay, KeepTheirEndAndThePosesOfWhatIsGone) {
  KeepTo(16);
  for (const std::uint32_t id : {36U, 37U, 38U, 39U}) {
    EXPECT_NE(map_.FindKeyframe(KeyframeId(id)), nullptr) << id;
  }
  for (std::uint32_t id = 0; id < 40; ++id) {
    EXPECT_TRUE(map_.FindKeyframePose(KeyframeId(id)).has_value()) << id;
  }
}

TEST_F(KeyframesAlongAWay, StayWhereTheyAloneKnowAPlace) {
  KeepTo(10);  // needs gaps of four and more
  const std::vector<std::uint32_t> left = Left(map_);
  for (std::size_t i = 1; i < left.size(); ++i) {
    EXPECT_LE(left[i] - left[i - 1], 6U) << "nothing is cut off from the rest on both sides";
  }
}

}  // namespace
}  // namespace ofm
