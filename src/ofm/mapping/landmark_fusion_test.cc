#include "ofm/mapping/landmark_fusion.h"

#include <gtest/gtest.h>

#include <set>

#include "ofm/mapping/test_mapping.h"

namespace ofm {
namespace {

using test::Changed;
using test::FindProblem;
using test::MadeFrame;
using test::TrueMap;

/// The second of two keyframes at true poses. Of what both see, every third landmark is known to be
/// the same; of the rest the second has duplicates.
struct TwoViews : TrueMap {
  explicit TwoViews(std::uint32_t second_frame = 4) {
    Add(world.Frame(0));
    frame = world.Frame(second_frame);
    names = association.Names(map, frame);
  }
  /// Adds the second keyframe; `with_depth` features become landmarks where they name none.
  KeyframeId AddSecond(const MadeFrame& second) {
    std::vector<LandmarkId> known = names;
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (!known[i].valid() || i % 3 == 0) continue;
      known[i] = LandmarkId();
      ++hidden;
    }
    return test::AddWithDepth(map, world.model(), second, second.camera_from_world, known);
  }

  MadeFrame frame;
  std::vector<LandmarkId> names;  // by feature of the second: what it shows
  int hidden = 0;                 // how many names the second keyframe was not told
};

int CountRightNames(const TwoViews& views, KeyframeId keyframe) {
  int right = 0;
  const std::vector<LandmarkId>& landmarks = views.map.GetKeyframe(keyframe).landmarks;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    right += views.names[i].valid() && landmarks[i].valid() &&
             views.map.FindLandmark(views.names[i])->id == landmarks[i];
  }
  return right;
}

TEST(LandmarkFusion, FusesDuplicates) {
  TwoViews views;
  const KeyframeId second = views.AddSecond(views.frame);
  ASSERT_GT(views.hidden, 100);
  const int fused = FuseWithNeighbours(views.map, second, views.world.model(), {});
  EXPECT_GT(fused, 0.9 * views.hidden);
  EXPECT_LE(fused, views.hidden);
  EXPECT_EQ(FindProblem(views.map), "");
  // All hidden ones that were fused now are the true landmark; none is another.
  for (std::size_t i = 0; i < views.names.size(); ++i) {
    const LandmarkId id = views.map.GetKeyframe(second).landmarks[i];
    if (!id.valid()) continue;
    const Eigen::Vector3d truth = views.world.points()[views.frame.shown[i].value];
    EXPECT_LT((views.map.GetLandmark(id).position_in_world - truth).norm(), 1e-3);
  }
  EXPECT_GT(CountRightNames(views, second), 0.9 * views.hidden);
}

TEST(LandmarkFusion, FindsNothingMoreTheSecondTime) {
  TwoViews views;
  const KeyframeId second = views.AddSecond(views.frame);
  EXPECT_GT(FuseWithNeighbours(views.map, second, views.world.model(), {}), 0);
  EXPECT_EQ(FuseWithNeighbours(views.map, second, views.world.model(), {}), 0);
}

TEST(LandmarkFusion, FreeFeaturesBecomeObservations) {
  TwoViews views;
  const MadeFrame without_depth = Changed(views.frame, [](FrameFeatures& features) {
    std::fill(features.depth_m.begin(), features.depth_m.end(), 0.0F);
  });
  const KeyframeId second = views.AddSecond(without_depth);
  const std::size_t landmarks = views.map.landmarks().size();
  EXPECT_EQ(FuseWithNeighbours(views.map, second, views.world.model(), {}), 0);
  EXPECT_EQ(views.map.landmarks().size(), landmarks);
  EXPECT_GT(CountRightNames(views, second), 0.9 * views.hidden);
  EXPECT_EQ(FindProblem(views.map), "");
}

TEST(LandmarkFusion, KeepsTheLandmarkWithMoreObservations) {
  TrueMap made;
  for (const std::uint32_t id : {0U, 1U, 2U}) made.Add(made.world.Frame(id));
  const MadeFrame frame = made.world.Frame(3);
  std::vector<LandmarkId> names = made.association.Names(made.map, frame);
  int victim = 0;
  while (!names[victim].valid() || made.map.GetLandmark(names[victim]).observations.size() < 3) {
    ++victim;
  }
  const LandmarkId old_one = names[victim];
  names[victim] = LandmarkId();
  const KeyframeId last =
      test::AddWithDepth(made.map, made.world.model(), frame, frame.camera_from_world, names);
  const LandmarkId new_one = made.map.GetKeyframe(last).landmarks[victim];
  ASSERT_NE(new_one, old_one);
  FuseWithNeighbours(made.map, last, made.world.model(), {});
  EXPECT_EQ(made.map.FindLandmark(new_one)->id, old_one);
  EXPECT_EQ(made.map.GetKeyframe(last).landmarks[victim], old_one);
}

TEST(LandmarkFusion, UnlikeDescriptorsAreNotFused) {
  TwoViews views;
  const MadeFrame unlike = Changed(views.frame, [](FrameFeatures& features) {
    for (Descriptor& d : features.descriptors) d = test::FlipBits(d, 60);
  });
  const KeyframeId second = views.AddSecond(unlike);
  MappingOptions options;
  options.max_hamming = 50;
  EXPECT_EQ(FuseWithNeighbours(views.map, second, views.world.model(), options), 0);
  EXPECT_EQ(FindProblem(views.map), "");
}

TEST(LandmarkFusion, OtherPlacesAndDepthsAreNotFused) {
  MeasurementModel strict = test::FeatureWorld().model();
  strict.options.pixel_sigma = 0.5;
  strict.options.inverse_depth_sigma = 0.01;
  struct Error {
    float shift_px, depth_factor;
  };
  for (const Error& error : {Error{20, 1}, Error{0, 1.5F}}) {
    TwoViews views;
    const MadeFrame wrong = Changed(views.frame, [&](FrameFeatures& features) {
      for (Eigen::Vector2f& p : features.ideal_px) p.x() += error.shift_px;
      for (float& depth : features.depth_m) depth *= error.depth_factor;
      features.grid = FeatureGrid(features.ideal_px, 640, 480);
    });
    const KeyframeId second = views.AddSecond(wrong);
    EXPECT_LT(FuseWithNeighbours(views.map, second, strict, {}), 3) << error.shift_px;
    EXPECT_EQ(FindProblem(views.map), "");
  }
}

TEST(LandmarkFusion, StrangersAreLeftAlone) {
  TwoViews views;
  views.names.assign(views.names.size(), LandmarkId());  // nothing in common, no neighbours
  const KeyframeId second = views.AddSecond(views.frame);
  EXPECT_EQ(FuseWithNeighbours(views.map, second, views.world.model(), {}), 0);
}

}  // namespace
}  // namespace ofm
