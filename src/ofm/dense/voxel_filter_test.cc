#include "ofm/dense/voxel_filter.h"

#include <gtest/gtest.h>

#include <limits>

namespace ofm {
namespace {

TEST(VoxelFilter, PointsOfAVoxelBecomeTheirMean) {
  VoxelFilter filter(.1);
  filter.Add({{.01f, .02f, .03f}, {10, 20, 30}, 5, 200});
  filter.Add({{.03f, .04f, .05f}, {20, 40, 61}, 5, 100});
  const auto points = filter.Points();
  ASSERT_EQ(points.size(), 1u);
  EXPECT_TRUE(points[0].position.isApprox(Eigen::Vector3f(.02f, .03f, .04f)));
  EXPECT_EQ(points[0].color, (Rgb{15, 30, 46}));
  EXPECT_EQ(points[0].class_id, 5);
  EXPECT_EQ(points[0].confidence, 150);
}

TEST(VoxelFilter, PreciseDepthCountsMore) {
  VoxelFilter filter(.1);
  filter.Add({{.01f, 0, .02f}, {}, 5, 200, kNoInstance, 3e4f});
  filter.Add({{.05f, 0, .06f}, {}, 5, 200, kNoInstance, 1e4f});
  const auto points = filter.Points();
  ASSERT_EQ(points.size(), 1u);
  EXPECT_TRUE(points[0].position.isApprox(Eigen::Vector3f(.02f, 0, .03f)));
  EXPECT_FLOAT_EQ(points[0].precision, 2e4f);
}

TEST(VoxelFilter, VoxelsKnowWhereTheyWereSeenFromAndHowSurelyAllInAll) {
  ViewVoxelFilter filter(.1);
  filter.Add({{.01f, 0, .02f}, {}, 5, 200, kNoInstance, 3e4f}, {4, 0, 0});
  filter.Add({{.05f, 0, .06f}, {}, 5, 200, kNoInstance, 1e4f}, {0, 0, 8});
  const auto voxels = filter.Voxels();
  ASSERT_EQ(voxels.size(), 1u);
  EXPECT_TRUE(voxels[0].viewpoint.isApprox(Eigen::Vector3f(3, 0, 2)));
  EXPECT_DOUBLE_EQ(voxels[0].precision, 4e4);
  EXPECT_EQ(voxels[0].point.position, filter.Points()[0].position);
}

TEST(VoxelFilter, TheLabelOfOneViewIsVotedAndOfManyViewsBelieved) {
  VoxelFilter one_view(.1);
  ViewVoxelFilter views(.1);
  for (int i = 0; i < 3; ++i) {
    one_view.Add({{0, 0, 0}, {}, 5, 200});
    views.Add({{0, 0, 0}, {}, 5, 200});
  }
  EXPECT_EQ(one_view.Points()[0].class_id, 5);
  EXPECT_EQ(one_view.Points()[0].confidence, 200);
  EXPECT_EQ(views.Points()[0].class_id, 5);
  EXPECT_EQ(views.Points()[0].confidence, 255);
}

TEST(VoxelFilter, TheInstanceOfMostPointsIsKeptWhereThereIsALabel) {
  VoxelFilter filter(.1);
  for (const std::uint16_t instance : {9, 2, 2, 9, 2}) {
    filter.Add({{.01f, 0, 0}, {}, 5, 200, instance});
  }
  filter.Add({{.11f, 0, 0}, {}, 5, 10, 4});
  filter.Add({{.11f, 0, 0}, {}, kNoLabel, 128});
  const auto points = filter.Points();
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].instance, 2);
  EXPECT_EQ(points[1].instance, kNoInstance);
}

TEST(VoxelFilter, VoxelsComeInTheOrderOfTheirFirstPoints) {
  VoxelFilter filter(.1);
  filter.Add({{.95f, 0, 0}, {}, 1, 1});
  filter.Add({{-.95f, 0, 0}, {}, 2, 1});
  filter.Add({{.91f, 0, 0}, {}, 1, 1});
  const auto points = filter.Points();
  ASSERT_EQ(points.size(), 2u);
  EXPECT_FLOAT_EQ(points[0].position.x(), .93f);
  EXPECT_FLOAT_EQ(points[1].position.x(), -.95f);
}

TEST(VoxelFilter, PointsThatAreNotFiniteAreLeftOut) {
  VoxelFilter filter(.1);
  filter.Add({{0, std::numeric_limits<float>::quiet_NaN(), 0}, {}, 1, 1});
  filter.Add({{0, 1e20f, 0}, {}, 1, 1});
  EXPECT_TRUE(filter.Points().empty());
}

}  // namespace
}  // namespace ofm
