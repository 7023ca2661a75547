#include "ofm/dense/navigation_grid.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <opencv2/imgcodecs.hpp>

#include "ofm/io/read_file.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

constexpr double kResolution_m = .05;
const Plane kFloor{Eigen::Vector3d::UnitZ(), 0};

void AddPoint(WorldScan& scan, double x, double y, double z) {
  scan.points.push_back({Eigen::Vector3d(x, y, z).cast<float>(), {}, 0, 0});
}

/// A floor from (0, 0) to (3, 2) with a table of 0.7 m and a lamp at 1.8 m over it, seen from
/// above its middle: the space between is free. Turned into another world.
SemanticOctree Room(const RigidTransform& world_from_room = {}) {
  WorldScan scan;
  scan.origin = Eigen::Vector3f(1.5f, 1, 2.5f);
  for (double x = .01; x < 3; x += .02) {
    for (double y = .01; y < 2; y += .02) {
      const bool table = x > 2 && x < 2.5 && y > .5 && y < 1;
      AddPoint(scan, x, y, table ? .71 : .01);
    }
  }
  for (double x = .5; x < .8; x += .02) AddPoint(scan, x, 1.52, 1.81);
  for (LabelledPoint& point : scan.points) {
    point.position =
        (world_from_room * Eigen::Vector3d(point.position.cast<double>())).cast<float>();
  }
  scan.origin = (world_from_room * Eigen::Vector3d(scan.origin.cast<double>())).cast<float>();
  SemanticOctree octree(kResolution_m, {});
  EXPECT_TRUE(octree.InsertScan(scan));
  return octree;
}

/// What the grid says of a point of the world.
GridCell CellAt(const NavigationGrid& grid, const Eigen::Vector3d& point_in_world) {
  const Eigen::Vector2d p = (grid.floor_from_world * point_in_world).head<2>() - grid.origin_m;
  const int column = static_cast<int>(p.x() / grid.resolution_m);
  const int row = grid.cells.rows - 1 - static_cast<int>(p.y() / grid.resolution_m);
  return static_cast<GridCell>(grid.cells.at<std::uint8_t>(row, column));
}

TEST(CutNavigationGrid, WhatStandsInTheBandObstructs) {
  const NavigationGrid grid = CutNavigationGrid(Room(), kFloor, {});
  EXPECT_EQ(CellAt(grid, {2.25, .75, 0}), GridCell::kOccupied) << "the table";
  EXPECT_EQ(CellAt(grid, {1.5, 1, 0}), GridCell::kFree) << "bare floor";
  EXPECT_EQ(CellAt(grid, {.65, 1.52, 0}), GridCell::kFree) << "under the lamp";
}

TEST(CutNavigationGrid, TheBandDecides) {
  NavigationOptions low, high;
  low.max_height_m = .5;
  high.max_height_m = 2;
  EXPECT_NE(CellAt(CutNavigationGrid(Room(), kFloor, low), {2.25, .75, 0}), GridCell::kOccupied);
  EXPECT_EQ(CellAt(CutNavigationGrid(Room(), kFloor, high), {.65, 1.52, 0}), GridCell::kOccupied);
}

TEST(CutNavigationGrid, ATurnedFloorHasNoHoles) {
  const RigidTransform world_from_room(
      Eigen::Quaterniond(Eigen::AngleAxisd(.7, Eigen::Vector3d(1, .4, .3).normalized())),
      Eigen::Vector3d(.3, -2, 1));
  const Eigen::Vector3d normal = world_from_room.rotation() * Eigen::Vector3d::UnitZ();
  const Plane floor{normal, -normal.dot(world_from_room.translation())};
  const NavigationGrid grid = CutNavigationGrid(Room(world_from_room), floor, {});
  for (double x = .2; x < 1.9; x += .03) {
    EXPECT_EQ(CellAt(grid, world_from_room * Eigen::Vector3d(x, 1, 0)), GridCell::kFree) << x;
  }
  EXPECT_EQ(CellAt(grid, world_from_room * Eigen::Vector3d(2.25, .75, 0)), GridCell::kOccupied);
}

TEST(CutNavigationGrid, WhereNothingWasSeenIsUnknown) {
  const NavigationGrid grid = CutNavigationGrid(Room(), Plane{Eigen::Vector3d::UnitZ(), 100}, {});
  EXPECT_TRUE(grid.cells.empty()) << "all is far over the band";
  const Eigen::Vector3d turned = Eigen::Vector3d(1, 1, 10).normalized();
  const NavigationGrid tilted = CutNavigationGrid(Room(), Plane{turned, 0}, {});
  EXPECT_GT(cv::countNonZero(tilted.cells == static_cast<int>(GridCell::kUnknown)), 0);
}

TEST(MakeNavigationGrid, FindsTheFloorItself) {
  const auto grid = MakeNavigationGrid(Room(), Eigen::Vector3d(.2, .1, 1).normalized(), {});
  ASSERT_TRUE(grid);
  EXPECT_NEAR((grid->floor_from_world * Eigen::Vector3d(1, 1, .5)).z(), .48, .03);
  EXPECT_EQ(CellAt(*grid, {2.25, .75, 0}), GridCell::kOccupied);
  EXPECT_EQ(CellAt(*grid, {1.5, 1, 0}), GridCell::kFree);
  EXPECT_FALSE(MakeNavigationGrid(SemanticOctree(.05, {}), Eigen::Vector3d::UnitZ(), {}));
}

TEST(FloorFromWorld, IsARotationThatBringsTheNormalUp) {
  for (const Eigen::Vector3d& normal :
       {Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 2, 3)}) {
    const Plane floor{normal.normalized(), .4};
    const RigidTransform floor_from_world = FloorFromWorld(floor);
    EXPECT_NEAR(floor_from_world.RotationMatrix().determinant(), 1, 1e-9);
    const Eigen::Vector3d point(.3, -.8, 2);
    EXPECT_NEAR((floor_from_world * point).z(), floor.Height_m(point), 1e-9);
  }
}

TEST(WriteNavigationGrid, IsWhatMapServerReads) {
  const TestFolder folder;
  const NavigationGrid grid = CutNavigationGrid(Room(), kFloor, {});
  WriteNavigationGrid(folder.path(), grid);
  const cv::Mat image = cv::imread(folder.path() / "map.pgm", cv::IMREAD_UNCHANGED);
  ASSERT_EQ(image.type(), CV_8UC1);
  EXPECT_EQ(cv::norm(image, grid.cells, cv::NORM_INF), 0);
  const std::string yaml = ReadFile(folder.path() / "map.yaml");
  for (const char* line :
       {"\nimage: map.pgm\n", "\nmode: trinary\n", "\nresolution: 0.05\n", "\nnegate: 0\n",
        "\noccupied_thresh: 0.65\n", "\nfree_thresh: 0.196\n"}) {
    EXPECT_NE(yaml.find(line), std::string::npos) << line;
  }
  EXPECT_NE(yaml.find(fmt::format("\norigin: [{}, {}, 0]\n", grid.origin_m.x(), grid.origin_m.y())),
            std::string::npos);
}

}  // namespace
}  // namespace ofm
