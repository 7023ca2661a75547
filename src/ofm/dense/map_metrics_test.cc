#include "ofm/dense/map_metrics.h"

#include <gtest/gtest.h>

#include "ofm/dense/octree_file.h"
#include "ofm/dense/semantic_mapper.h"
#include "ofm/dense/test_scene.h"

namespace ofm {
namespace {

using test::Chair, test::Person, test::SmallCamera, test::Wall;

/// Frames in which somebody walks before the wall; the instance ids are those of the mask.
std::vector<LabelledFrame> WalkingFrames() {
  std::vector<LabelledFrame> frames;
  for (std::uint32_t i = 0; i < 5; ++i) {
    const std::vector<test::Box> boxes{Wall(), Chair(), Person(.2 * i - .5)};
    frames.push_back(Render(SmallCamera(), boxes, RigidTransform(), KeyframeId(i)));
  }
  return frames;
}

MapMetricsMeter MeterOf(const std::vector<LabelledFrame>& frames) {
  MapMetricsMeter meter(SmallCamera(), {});
  for (const LabelledFrame& frame : frames) {
    meter.AddFrame(RigidTransform(), frame.depth_m, frame.dynamic_mask / 255);
  }
  return meter;
}

std::unique_ptr<octomap::ColorOcTree> MapOf(const std::vector<LabelledFrame>& frames) {
  SemanticMapper mapper(SmallCamera(), {});
  std::map<KeyframeId, RigidTransform> poses;
  for (const LabelledFrame& frame : frames) {
    mapper.AddKeyframe(frame);
    poses[frame.id] = RigidTransform();
  }
  return MakeColorOcTree(mapper.Build(poses).octree);
}

TEST(MapMetrics, AMapWithMasksHasNoResidueAndTheWholeWall) {
  const auto frames = WalkingFrames();
  const MapMetrics metrics = MeterOf(frames).Evaluate(*MapOf(frames));
  EXPECT_GT(metrics.actor_only_voxels, 100u);
  EXPECT_EQ(metrics.actor_only_occupied, 0u);
  EXPECT_EQ(metrics.actor_residue_share, 0);
  EXPECT_GT(metrics.static_voxels, 2000u);
  EXPECT_GT(metrics.static_coverage, .9);
  EXPECT_GE(metrics.static_coverage_near, metrics.static_coverage);
}

TEST(MapMetrics, AMapWithoutMasksHasResidue) {
  auto frames = WalkingFrames();
  const MapMetricsMeter meter = MeterOf(frames);
  frames.resize(1);
  frames[0].dynamic_mask = cv::Mat();
  const MapMetrics metrics = meter.Evaluate(*MapOf(frames));
  EXPECT_GT(metrics.actor_residue_share, .1);  // one stand of five
  EXPECT_LT(metrics.actor_residue_share, .5);
}

TEST(MapMetrics, AnEmptyMapHasNeitherResidueNorCoverage) {
  const MapMetrics metrics = MeterOf(WalkingFrames()).Evaluate(octomap::ColorOcTree(.05));
  EXPECT_GT(metrics.actor_only_voxels, 100u);
  EXPECT_EQ(metrics.actor_only_occupied, 0u);
  EXPECT_EQ(metrics.static_coverage_near, 0);
}

/// One pixel of a camera, at depth 1 m.
cv::Mat OnePixel(int row, int column) {
  cv::Mat depth(120, 160, CV_32FC1, cv::Scalar(0));
  depth.at<float>(row, column) = 1;
  return depth;
}

TEST(MapMetrics, VoxelsThatTheStaticSceneAlsoFillsDoNotCount) {
  const cv::Mat all(120, 160, CV_8UC1, cv::Scalar(1));
  MapMetricsMeter meter(SmallCamera(), {.min_static_frames = 2});
  const octomap::ColorOcTree empty(.05);
  meter.AddFrame(RigidTransform(), OnePixel(60, 80), all);
  EXPECT_EQ(meter.Evaluate(empty).actor_only_voxels, 1u);
  meter.AddFrame(RigidTransform(), OnePixel(60, 80), cv::Mat());
  EXPECT_EQ(meter.Evaluate(empty).actor_only_voxels, 0u);
  EXPECT_EQ(meter.Evaluate(empty).static_voxels, 0u);
  meter.AddFrame(RigidTransform(), OnePixel(60, 80), cv::Mat());
  EXPECT_EQ(meter.Evaluate(empty).static_voxels, 1u);
}

TEST(MapMetrics, ANeighboringVoxelCountsAsNear) {
  MapMetricsMeter meter(SmallCamera(), {.min_static_frames = 1});
  meter.AddFrame(RigidTransform(), OnePixel(60, 80), cv::Mat());
  octomap::ColorOcTree tree(.05);
  tree.updateNode(octomap::point3d(.01f, .01f, 1.06f), true);
  MapMetrics metrics = meter.Evaluate(tree);
  EXPECT_EQ(metrics.static_coverage, 0);
  EXPECT_EQ(metrics.static_coverage_near, 1);
  tree.updateNode(octomap::point3d(.01f, .01f, 1.01f), true);
  EXPECT_EQ(meter.Evaluate(tree).static_coverage, 1);
}

TEST(MapMetrics, FarPixelsAndOtherResolutionsAreLeftOut) {
  MapMetricsMeter meter(SmallCamera(), {.range_m = .9, .min_static_frames = 1});
  meter.AddFrame(RigidTransform(), OnePixel(60, 80), cv::Mat());
  EXPECT_EQ(meter.Evaluate(octomap::ColorOcTree(.05)).static_voxels, 0u);
  EXPECT_THROW(meter.Evaluate(octomap::ColorOcTree(.1)), std::logic_error);
  EXPECT_THROW(meter.AddFrame(RigidTransform(), cv::Mat(), cv::Mat()), std::logic_error);
}

}  // namespace
}  // namespace ofm
