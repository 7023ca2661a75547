#include "ofm/dense/floor_plane.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <vector>

namespace ofm {
namespace {

constexpr double kResolution_m = .05;

/// Points of a rectangle at a height, one per voxel's side.
void AddRectangle(std::vector<Eigen::Vector3f>& points, const Eigen::AlignedBox2d& area,
                  double height_m) {
  for (double x = area.min().x(); x < area.max().x(); x += kResolution_m)
    for (double y = area.min().y(); y < area.max().y(); y += kResolution_m)
      points.emplace_back(Eigen::Vector3d(x, y, height_m).cast<float>());
}

/// A floor of 4 m², a larger table top over it and a wall; z is up.
std::vector<Eigen::Vector3f> Room() {
  std::vector<Eigen::Vector3f> points;
  AddRectangle(points, {Eigen::Vector2d(0, 0), Eigen::Vector2d(2, 2)}, 0);
  AddRectangle(points, {Eigen::Vector2d(2, 0), Eigen::Vector2d(5, 2)}, .7);
  for (double z = 0; z < 2; z += kResolution_m)
    for (double x = 0; x < 5; x += kResolution_m)
      points.emplace_back(Eigen::Vector3d(x, 2, z).cast<float>());
  return points;
}

TEST(FindFloor, IsTheLowestLargePlaneNotTheLargest) {
  const auto floor = FindFloor(Room(), Eigen::Vector3d(.3, -.2, 1).normalized(), kResolution_m, {});
  ASSERT_TRUE(floor);
  EXPECT_GT(floor->normal.z(), .999);
  EXPECT_NEAR(floor->Height_m({1, 1, 0}), 0, .01);
  EXPECT_NEAR(floor->Height_m({1, 1, 1}), 1, .02) << "heights grow upwards";
}

TEST(FindFloor, DoesNotDependOnTheWorldsAxes) {
  const Eigen::AngleAxisd turn(1.1, Eigen::Vector3d(1, 2, -1).normalized());
  std::vector<Eigen::Vector3f> points = Room();
  for (Eigen::Vector3f& point : points) point = turn.cast<float>() * point;
  const auto floor = FindFloor(points, turn * Eigen::Vector3d::UnitZ(), kResolution_m, {});
  ASSERT_TRUE(floor);
  EXPECT_GT(floor->normal.dot(turn * Eigen::Vector3d::UnitZ()), .999);
}

TEST(FindFloor, AWallIsNone) {
  std::vector<Eigen::Vector3f> wall;
  for (double z = 0; z < 2; z += kResolution_m)
    for (double x = 0; x < 5; x += kResolution_m)
      wall.emplace_back(Eigen::Vector3d(x, 2, z).cast<float>());
  EXPECT_FALSE(FindFloor(wall, Eigen::Vector3d::UnitZ(), kResolution_m, {}));
}

TEST(FindFloor, NeedsEnoughOfIt) {
  std::vector<Eigen::Vector3f> patch;
  AddRectangle(patch, {Eigen::Vector2d(0, 0), Eigen::Vector2d(.6, .6)}, 0);
  EXPECT_FALSE(FindFloor(patch, Eigen::Vector3d::UnitZ(), kResolution_m, {}));
  FloorOptions small;
  small.min_area_m2 = .3;
  EXPECT_TRUE(FindFloor(patch, Eigen::Vector3d::UnitZ(), kResolution_m, small));
}

TEST(FindFloor, OfNothingThereIsNone) {
  EXPECT_FALSE(FindFloor({}, Eigen::Vector3d::UnitZ(), kResolution_m, {}));
}

TEST(MeanUp, IsAgainstTheImagesYAxisOnAverage) {
  const auto tilted = [](double angle_rad) {
    return RigidTransform(
        Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitX())), {1, 2, 3});
  };
  const Eigen::Vector3d up = MeanUp({{KeyframeId(0), tilted(.3)}, {KeyframeId(1), tilted(-.3)}});
  EXPECT_LT((up - Eigen::Vector3d(0, -1, 0)).norm(), 1e-9);
  EXPECT_NEAR(MeanUp({{KeyframeId(0), tilted(.3)}}).z(), -std::sin(.3), 1e-9);
}

TEST(MeanUp, PosesThatAreNotFiniteSayNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const RigidTransform lost(Eigen::Quaterniond(nan, nan, nan, nan), {nan, nan, nan});
  EXPECT_EQ(MeanUp({{KeyframeId(0), lost}}), -Eigen::Vector3d::UnitY());
  EXPECT_EQ(MeanUp({{KeyframeId(0), lost}, {KeyframeId(1), RigidTransform()}}),
            -Eigen::Vector3d::UnitY());
  EXPECT_EQ(MeanUp({}), -Eigen::Vector3d::UnitY());
}

}  // namespace
}  // namespace ofm
