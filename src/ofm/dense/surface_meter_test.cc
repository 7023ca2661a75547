#include "ofm/dense/surface_meter.h"

#include <gtest/gtest.h>

#include "ofm/dense/octree_file.h"
#include "ofm/dense/semantic_mapper.h"
#include "ofm/dense/test_scene.h"

namespace ofm {
namespace {

using test::At, test::Chair, test::Person, test::SmallCamera, test::Wall;

constexpr int kFrames = 4;

LabelledFrame Look(const std::vector<test::Box>& boxes, int frame) {
  return Render(SmallCamera(), boxes, At(.05 * frame, 0, 0),
                KeyframeId(static_cast<std::uint32_t>(frame)));
}

SemanticMap MapOf(const std::vector<test::Box>& boxes, const RigidTransform& error = {}) {
  SemanticMapper mapper(SmallCamera(), {});
  KeyframePoseMap poses;
  for (int i = 0; i < kFrames; ++i) {
    const LabelledFrame frame = Look(boxes, i);
    mapper.AddKeyframe(frame);
    poses[frame.id] = error * At(.05 * i, 0, 0);
  }
  return mapper.Build(poses);
}

/// Against the wall and the chair as they truly are.
SurfaceMetrics Measure(const SemanticMap& map, int frames = kFrames) {
  SurfaceMeter meter(SmallCamera(), {});
  for (int i = 0; i < frames; ++i) {
    meter.AddFrame(At(.05 * i, 0, 0), Look({Wall(), Chair()}, i).depth_m);
  }
  return meter.Evaluate(*MakeColorOcTree(map.octree), map.cloud_in_world);
}

TEST(SurfaceMeter, ATrueMapIsWholeAndExact) {
  const SurfaceMetrics metrics = Measure(MapOf({Wall(), Chair()}));
  EXPECT_GT(metrics.surface_voxels, 3000u);
  EXPECT_GT(metrics.mapped_share, .98);
  EXPECT_GT(metrics.points, 1000u);
  // What fewer than three frames saw, at the rim of the view.
  EXPECT_LT(metrics.points_off, metrics.points / 20);
  EXPECT_LT(metrics.median_distance_m, 1e-4);
}

TEST(SurfaceMeter, WhatSomebodyAlwaysHidIsNotMapped) {
  const double whole = Measure(MapOf({Wall(), Chair()})).mapped_share;
  const SurfaceMetrics metrics = Measure(MapOf({Wall(), Chair(), Person(0)}));
  EXPECT_LT(metrics.mapped_share, whole - .1);
  EXPECT_LT(metrics.median_distance_m, 1e-4);
}

TEST(SurfaceMeter, WhatIsNeverSeenIsToldApart) {
  SurfaceMeter meter(SmallCamera(), {});
  for (int i = 0; i < kFrames; ++i) {
    const RigidTransform pose = At(.05 * i, 0, 0);
    const LabelledFrame hidden = Look({Wall(), Chair(), Person(0)}, i);
    meter.AddFrame(pose, Look({Wall(), Chair()}, i).depth_m);
    meter.AddView(pose, hidden.depth_m, hidden.dynamic_mask);
  }
  const SemanticMap map = MapOf({Wall(), Chair(), Person(0)});
  const SurfaceMetrics metrics = meter.Evaluate(*MakeColorOcTree(map.octree), map.cloud_in_world);
  EXPECT_LT(metrics.seen, .9 * metrics.surface_voxels);
  EXPECT_GT(metrics.seen, .6 * metrics.surface_voxels);
  EXPECT_GT(metrics.seen_mapped, .96 * metrics.seen);
  EXPECT_LE(metrics.seen_mapped, metrics.mapped);
}

TEST(SurfaceMeter, AMapThatIsOffIsInaccurate) {
  const SurfaceMetrics metrics = Measure(MapOf({Wall(), Chair()}, At(0, 0, .03)));
  EXPECT_NEAR(metrics.median_distance_m, .03, 1e-3);
  const SurfaceMetrics far = Measure(MapOf({Wall(), Chair()}, At(0, 0, -.4)));
  EXPECT_GT(far.points_off, far.points * 9 / 10);
  EXPECT_EQ(far.median_distance_m, .1);
  EXPECT_LT(far.mapped_share, .1);
}

TEST(SurfaceMeter, AVoxelNeedsSeveralFrames) {
  EXPECT_EQ(Measure(MapOf({Wall()}), 2).surface_voxels, 0u);
  EXPECT_GT(Measure(MapOf({Wall()}), 3).surface_voxels, 0u);
}

TEST(SurfaceMeter, AnEmptyMapHasNoPointsAndNothingMapped) {
  const SurfaceMetrics metrics = Measure({{}, SemanticOctree(.05, {})});
  EXPECT_GT(metrics.surface_voxels, 3000u);
  EXPECT_EQ(metrics.mapped, 0u);
  EXPECT_EQ(metrics.points, 0u);
  EXPECT_EQ(metrics.median_distance_m, 0);
}

TEST(SurfaceMeter, WrongImagesAndResolutionsAreAProgrammersError) {
  SurfaceMeter meter(SmallCamera(), {});
  EXPECT_THROW(meter.AddFrame(RigidTransform(), cv::Mat()), std::logic_error);
  EXPECT_THROW(meter.Evaluate(octomap::ColorOcTree(.1), {}), std::logic_error);
}

}  // namespace
}  // namespace ofm
