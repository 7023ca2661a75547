#include "ofm/objects/oriented_box.h"

#include <gtest/gtest.h>

#include <vector>

namespace ofm {
namespace {

const Eigen::Vector3d kUp = Eigen::Vector3d(0.2, -1, 0.1).normalized();

/// A box of 0.6 x 0.3 x 0.2 m, turned by `yaw_rad` about kUp, as a grid of points.
struct Grid {
  explicit Grid(double yaw_rad) {
    x = Eigen::AngleAxisd(yaw_rad, kUp) * kUp.unitOrthogonal();
    const Eigen::Vector3d y = kUp.cross(x);
    for (int i = 0; i <= 30; ++i) {
      for (int j = 0; j <= 15; ++j) {
        for (int k = 0; k <= 10; ++k) {
          points.push_back(
              (center + (.02 * i - .3) * x + (.02 * j - .15) * y + (.02 * k - .1) * kUp)
                  .cast<float>());
        }
      }
    }
  }
  Eigen::Vector3d center{1, 2, 3}, x;
  std::vector<Eigen::Vector3f> points;
};

TEST(FitOrientedBox, FindsHowABoxIsTurned) {
  for (const double yaw_rad : {0.0, 0.3, 1.2, 2.5}) {
    const Grid grid(yaw_rad);
    const OrientedBox box = FitOrientedBox(grid.points, kUp, 0);
    EXPECT_LT((box.center_in_world - grid.center).norm(), .01) << yaw_rad;
    EXPECT_LT((box.size_m - Eigen::Vector3d(.6, .3, .2)).norm(), .02) << yaw_rad;
    EXPECT_GT(std::abs((box.world_from_box * Eigen::Vector3d::UnitX()).dot(grid.x)), .999);
    EXPECT_GT((box.world_from_box * Eigen::Vector3d::UnitZ()).dot(kUp), .9999);
  }
}

TEST(FitOrientedBox, SomeWrongPointsDoNotMatterWhenTrimmed) {
  Grid grid(0.4);
  const std::size_t points = grid.points.size();
  for (std::size_t i = 0; i < points / 100; ++i) {
    grid.points.emplace_back(1 + .001F * static_cast<float>(i), 2, 5);
  }
  const OrientedBox trimmed = FitOrientedBox(grid.points, kUp, .02);
  EXPECT_LT((trimmed.size_m - Eigen::Vector3d(.6, .3, .2)).norm(), .05);
  EXPECT_GT(FitOrientedBox(grid.points, kUp, 0).size_m.norm(), 1);
}

TEST(FitOrientedBox, OfNothingIsEmpty) {
  EXPECT_EQ(FitOrientedBox({}, kUp, .02).size_m, Eigen::Vector3d::Zero());
  const std::vector<Eigen::Vector3f> one{{1, 2, 3}};
  const OrientedBox box = FitOrientedBox(one, kUp, .02);
  EXPECT_LT((box.center_in_world - Eigen::Vector3d(1, 2, 3)).norm(), 1e-6);
  EXPECT_LT(box.size_m.norm(), 1e-6);
}

}  // namespace
}  // namespace ofm
