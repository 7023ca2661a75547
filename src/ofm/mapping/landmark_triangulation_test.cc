#include "ofm/mapping/landmark_triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ofm/mapping/test_mapping.h"

namespace ofm {
namespace {

using test::Changed;
using test::FindProblem;
using test::MadeFrame;
using test::TrueMap;

/// Half of the landmarks have no depth.
test::FeatureWorldOptions HalfDepth() {
  test::FeatureWorldOptions options = test::DefaultWorld();
  options.depthless_share = 0.5;
  return options;
}

/// Features of the second frame without depth whose landmark the first frame sees too.
int CountOpenInBoth(const MadeFrame& a, const MadeFrame& b) {
  int count = 0;
  for (std::size_t i = 0; i < b.shown.size(); ++i) {
    count += b.features->depth_m[i] <= 0 &&
             std::binary_search(a.shown.begin(), a.shown.end(), b.shown[i]);
  }
  return count;
}

/// The worst distance of a landmark from what its features show; 1000 where they show two things.
double WorstError_m(const TrueMap& made, const std::vector<MadeFrame>& frames,
                    const std::vector<LandmarkId>& landmarks) {
  double worst = 0;
  for (const LandmarkId id : landmarks) {
    const Landmark& landmark = made.map.GetLandmark(id);
    for (const Landmark::Observation& o : landmark.observations) {
      const LandmarkId shown = frames[o.keyframe.value].shown[o.feature];
      const Eigen::Vector3d& truth = made.world.points()[shown.value];
      worst = std::max(worst, (landmark.position_in_world - truth).norm());
    }
  }
  return worst;
}

TEST(LandmarkTriangulation, FindsPointsWhoseDepthWasNotMeasured) {
  TrueMap made(HalfDepth());
  const std::vector<MadeFrame> frames = {made.world.Frame(0), made.world.Frame(5)};
  for (const MadeFrame& frame : frames) made.Add(frame);
  const std::size_t before = made.map.landmarks().size();
  const auto created = TriangulateWithNeighbours(made.map, KeyframeId(1), made.world.model(), {});
  EXPECT_GT(created.size(), 0.7 * CountOpenInBoth(frames[0], frames[1]));
  EXPECT_EQ(made.map.landmarks().size(), before + created.size());
  EXPECT_LT(WorstError_m(made, frames, created), 0.01);
  EXPECT_EQ(FindProblem(made.map), "");
  for (const LandmarkId id : created) {
    EXPECT_EQ(made.map.GetLandmark(id).observations.size(), 2U);
    EXPECT_EQ(made.map.GetLandmark(id).first_keyframe, KeyframeId(1));
  }
}

TEST(LandmarkTriangulation, LeavesTheFeaturesThatHaveCloseDepthAlone) {
  TrueMap made;
  for (const std::uint32_t id : {0U, 5U}) made.Add(made.world.Frame(id));
  std::vector<LandmarkId> all;
  made.map.landmarks().ForEach([&](const Landmark& landmark) { all.push_back(landmark.id); });
  for (std::size_t i = 0; i < all.size(); i += 3) {
    if (made.map.GetLandmark(all[i]).observations.size() == 2) made.map.RemoveLandmark(all[i]);
  }
  const auto created = TriangulateWithNeighbours(made.map, KeyframeId(1), made.world.model(), {});
  for (const LandmarkId id : created) {
    const int feature = made.map.GetLandmark(id).FeatureIn(KeyframeId(1));
    EXPECT_GT(made.map.GetKeyframe(KeyframeId(1)).features->depth_m[feature],
              made.world.model().CloseDepth());
  }
  EXPECT_GT(created.size(), 0U) << "far ones may be triangulated";
}

TEST(LandmarkTriangulation, NeedsABaseline) {
  TrueMap made(HalfDepth());
  for (int i = 0; i < 2; ++i) made.Add(made.world.Frame(0));
  EXPECT_TRUE(TriangulateWithNeighbours(made.map, KeyframeId(1), made.world.model(), {}).empty());
}

TEST(LandmarkTriangulation, NeedsParallax) {
  TrueMap made(HalfDepth());
  for (const std::uint32_t id : {0U, 5U}) made.Add(made.world.Frame(id));
  MappingOptions options;
  options.min_parallax_deg = 20;
  EXPECT_TRUE(
      TriangulateWithNeighbours(made.map, KeyframeId(1), made.world.model(), options).empty());
}

/// Depth of what a feature shows [m].
double TrueDepth(const TrueMap& made, const MadeFrame& frame, int feature) {
  const Eigen::Vector3d& point = made.world.points()[frame.shown[feature].value];
  return (made.map.GetKeyframe(KeyframeId(1)).camera_from_world * point).z();
}

TEST(LandmarkTriangulation, RefusesWhatIsNearerThanAllThatHasDepth) {
  TrueMap made(HalfDepth());
  const MadeFrame first = made.world.Frame(0);
  std::vector<float> depths = first.features->depth_m;
  std::erase(depths, 0.0F);
  std::ranges::nth_element(depths, depths.begin() + depths.size() / 3);
  const float nearest = depths[depths.size() / 3];
  const auto without_near_depth = [&](FrameFeatures& features) {
    std::ranges::replace_if(
        features.depth_m, [&](float d) { return d < nearest; }, 0.0F);
  };
  const MadeFrame second = Changed(made.world.Frame(5), without_near_depth);
  made.Add(Changed(first, without_near_depth));
  made.Add(second);
  const auto created = TriangulateWithNeighbours(made.map, KeyframeId(1), made.world.model(), {});
  EXPECT_GT(created.size(), 5U);
  for (const LandmarkId id : created) {
    const Keyframe keyframe = made.map.GetKeyframe(KeyframeId(1));
    const Eigen::Vector3d& point = made.map.GetLandmark(id).position_in_world;
    EXPECT_GE((keyframe.camera_from_world * point).z(), nearest);
  }
  int nearer = 0;
  for (int i = 0; i < static_cast<int>(second.shown.size()); ++i) {
    nearer += second.features->depth_m[i] <= 0 && TrueDepth(made, second, i) < nearest;
  }
  EXPECT_GT(nearer, 20) << "there were some to refuse";
}

TEST(LandmarkTriangulation, NeedsANeighbour) {
  TrueMap made(HalfDepth());
  for (const std::uint32_t id : {0U, 5U}) made.Add(made.world.Frame(id));
  MappingOptions options;
  options.neighbours = 0;
  EXPECT_TRUE(
      TriangulateWithNeighbours(made.map, KeyframeId(1), made.world.model(), options).empty());
}

TEST(LandmarkTriangulation, RefusesUnlikeDescriptors) {
  TrueMap made(HalfDepth());
  made.Add(made.world.Frame(0));
  made.Add(Changed(made.world.Frame(5), [](FrameFeatures& features) {
    for (Descriptor& d : features.descriptors) d = test::FlipBits(d, 60);
  }));
  MappingOptions options;
  options.max_hamming = 50;
  EXPECT_TRUE(
      TriangulateWithNeighbours(made.map, KeyframeId(1), made.world.model(), options).empty());
}

TEST(LandmarkTriangulation, RefusesFeaturesOffTheEpipolarLine) {
  TrueMap made(HalfDepth());
  made.Add(made.world.Frame(0));
  // The camera goes aside, so that the epipolar lines are level.
  const RigidTransform aside(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.2, 0, 0));
  const MadeFrame beside = made.world.Look(5, 0.5, aside * made.world.Frame(0).camera_from_world);
  made.Add(Changed(beside, [](FrameFeatures& features) {
    for (std::size_t i = 0; i < features.size(); ++i) {
      if (features.depth_m[i] <= 0) features.ideal_px[i].y() += 15;
    }
    features.grid = FeatureGrid(features.ideal_px, 640, 480);
  }));
  EXPECT_TRUE(TriangulateWithNeighbours(made.map, KeyframeId(1), made.world.model(), {}).empty());
}

TEST(LandmarkTriangulation, GoesOnWithTheNextNeighbour) {
  TrueMap made(HalfDepth());
  const std::vector<MadeFrame> frames = {made.world.Frame(0), made.world.Frame(12),
                                         made.world.Frame(5)};
  for (const MadeFrame& frame : frames) made.Add(frame);
  const auto created = TriangulateWithNeighbours(made.map, KeyframeId(2), made.world.model(), {});
  int with_first = 0, with_second = 0;
  for (const LandmarkId id : created) {
    with_first += made.map.GetLandmark(id).FeatureIn(KeyframeId(0)) >= 0;
    with_second += made.map.GetLandmark(id).FeatureIn(KeyframeId(1)) >= 0;
  }
  EXPECT_GT(with_first, 0);
  EXPECT_GT(with_second, 0);
  EXPECT_LT(WorstError_m(made, frames, created), 0.01);
  EXPECT_EQ(FindProblem(made.map), "");
}

}  // namespace
}  // namespace ofm
