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

}  // namespace
}  // namespace ofm
