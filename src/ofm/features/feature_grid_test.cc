#include "ofm/features/feature_grid.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ofm/base/random.h"

namespace ofm {
namespace {

std::vector<int> Near(const FeatureGrid& grid, const Eigen::Vector2f& centre, float radius_px) {
  std::vector<int> visited;
  grid.VisitNear(centre, radius_px, [&](int i) { visited.push_back(i); });
  return visited;
}

std::vector<int> Sorted(std::vector<int> indices) {
  std::sort(indices.begin(), indices.end());
  return indices;
}

/// Points in and a little around an image of 100 x 70.
std::vector<Eigen::Vector2f> RandomPoints(int count) {
  RandomEngine engine = MakeRandomEngine(2, 0);
  std::vector<Eigen::Vector2f> points;
  for (int i = 0; i < count; ++i) {
    const double x = UniformReal(engine), y = UniformReal(engine);
    points.emplace_back(-10 + 120 * x, -10 + 90 * y);
  }
  return points;
}

TEST(FeatureGrid, EmptyGridHasNoPoints) {
  EXPECT_TRUE(Near(FeatureGrid(), {50, 50}, 100).empty());
  EXPECT_TRUE(Near(FeatureGrid({}, 100, 70), {50, 50}, 100).empty());
}

TEST(FeatureGrid, VisitsEveryPointWithinTheRadiusOnce) {
  const auto points = RandomPoints(500);
  const FeatureGrid grid(points, 100, 70);
  for (const Eigen::Vector2f& centre : RandomPoints(50)) {
    for (const float radius : {0.0F, 3.0F, 20.0F, 300.0F}) {
      const std::vector<int> visited = Sorted(Near(grid, centre, radius));
      EXPECT_EQ(std::adjacent_find(visited.begin(), visited.end()), visited.end());
      for (int i = 0; i < 500; ++i) {
        if ((points[i] - centre).cwiseAbs().maxCoeff() > radius) continue;
        EXPECT_TRUE(std::binary_search(visited.begin(), visited.end(), i));
      }
    }
  }
}

TEST(FeatureGrid, LooksOnlyAtTheCellsThatTheSquareTouches) {
  const std::vector<Eigen::Vector2f> points = {{8, 8}, {24, 8}, {40, 8}, {8, 24}, {24, 24}};
  const FeatureGrid grid(points, 100, 70);
  EXPECT_EQ(Near(grid, {8, 8}, 1), (std::vector<int>{0}));
  EXPECT_EQ(Near(grid, {24, 8}, 7), (std::vector<int>{1}));
  EXPECT_EQ(Near(grid, {15, 8}, 2), (std::vector<int>{0, 1}));
  EXPECT_EQ(Near(grid, {15, 15}, 2), (std::vector<int>{0, 1, 3, 4}));
  EXPECT_EQ(Near(grid, {24, 8}, 9), (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(FeatureGrid, PointsOutsideBelongToTheNearestCell) {
  const std::vector<Eigen::Vector2f> points = {{-40, -5}, {140, 90}};
  const FeatureGrid grid(points, 100, 70);
  EXPECT_EQ(Near(grid, {5, 5}, 1), (std::vector<int>{0}));
  EXPECT_EQ(Near(grid, {99, 69}, 0), (std::vector<int>{1}));
  EXPECT_EQ(Near(grid, {200, 200}, 1), (std::vector<int>{1})) << "a search outside, likewise";
  EXPECT_EQ(Near(grid, {-200, -200}, 1), (std::vector<int>{0}));
}

TEST(FeatureGrid, OrderIsFixedAndByIndexWithinACell) {
  const std::vector<Eigen::Vector2f> points = {{20, 20}, {1, 1}, {21, 21}, {2, 2}, {22, 22}};
  const FeatureGrid grid(points, 100, 70);
  EXPECT_EQ(Near(grid, {16, 16}, 10), (std::vector<int>{1, 3, 0, 2, 4}));
}

TEST(FeatureGrid, SizesThatAreNoMultipleOfACellAreCovered) {
  for (const int size : {1, 15, 16, 17, 33}) {
    const std::vector<Eigen::Vector2f> points = {{static_cast<float>(size) - 0.5F, 0}};
    EXPECT_EQ(Near(FeatureGrid(points, size, size), points[0], 1), (std::vector<int>{0})) << size;
  }
}

}  // namespace
}  // namespace ofm
