#include "ofm/estimation/reprojection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ofm/estimation/test_world.h"

namespace ofm {
namespace {

PointObservation SomeObservation() {
  PointObservation seen;
  seen.ideal_px = {200, 300};
  seen.depth_m = 2;
  seen.pixel_sigma = 1.5;
  seen.inverse_depth_sigma = 0.01;
  return seen;
}

TEST(Reprojection, TheResidualIsInStandardDeviations) {
  const PinholeCamera camera;
  PointObservation seen = SomeObservation();
  const Eigen::Vector3d point = camera.UnprojectIdeal({197, 303}, 4);
  const Eigen::Vector3d residual = ReprojectionResidual(camera, point, seen);
  EXPECT_NEAR(residual.x(), 3 / 1.5, 1e-9);
  EXPECT_NEAR(residual.y(), -3 / 1.5, 1e-9);
  EXPECT_NEAR(residual.z(), (0.5 - 0.25) / 0.01, 1e-9);
  EXPECT_NEAR(ReprojectionChiSquare(camera, point, seen), 8 + 625, 1e-9);
  seen.depth_m = 0;
  EXPECT_NEAR(ReprojectionChiSquare(camera, point, seen), 8, 1e-9);
}

TEST(Reprojection, PointsBehindTheCameraAreInfinitelyWrong) {
  const PinholeCamera camera;
  EXPECT_FALSE(IsBeforeCamera({0.1, 0.2, -1}));
  EXPECT_FALSE(IsBeforeCamera({0.1, 0.2, 0}));
  EXPECT_TRUE(IsBeforeCamera({0.1, 0.2, 1}));
  EXPECT_TRUE(std::isinf(ReprojectionChiSquare(camera, {0.1, 0.2, -1}, SomeObservation())));
}

TEST(Reprojection, TheGateIsWiderWithDepth) {
  PointObservation seen = SomeObservation();
  EXPECT_EQ(ChiSquareGate(seen), 7.815);
  seen.depth_m = 0;
  EXPECT_EQ(ChiSquareGate(seen), 5.991);
}

TEST(Reprojection, JacobiansEqualNumericOnes) {
  const PinholeCamera camera = *FindCameraPreset("tum-fr1");
  constexpr double kStep = 1e-6;
  RandomEngine engine = MakeRandomEngine(1, 0);
  for (int trial = 0; trial < 20; ++trial) {
    PointObservation seen = SomeObservation();
    if (trial % 2) seen.depth_m = 0;
    const Eigen::Vector3d point =
        camera.UnprojectIdeal(test::RandomPixel(camera, engine), test::RandomDepth_m(engine));
    const Eigen::Matrix3d by_point = ReprojectionJacobian(camera, point, seen);
    const Eigen::Matrix<double, 3, 6> by_pose = by_point * LeftPerturbationJacobian(point);
    const auto residual = [&](const Eigen::Vector3d& p) {
      return ReprojectionResidual(camera, p, seen);
    };
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
      const Eigen::Vector3d numeric = (residual(point + step) - residual(point - step)) / 2 / kStep;
      EXPECT_LT((by_point.col(i) - numeric).norm(), 1e-6 * (1 + numeric.norm())) << i;
    }
    for (int i = 0; i < 6; ++i) {
      const Vector6d step = kStep * Vector6d::Unit(i);
      const Eigen::Vector3d numeric =
          (residual(ExpSe3(step) * point) - residual(ExpSe3(-step) * point)) / 2 / kStep;
      EXPECT_LT((by_pose.col(i) - numeric).norm(), 1e-6 * (1 + numeric.norm())) << i;
    }
  }
}

TEST(Reprojection, ObservationsThatMakeNoSenseAreNotValid) {
  EXPECT_TRUE(IsValid(SomeObservation()));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto is_valid_with = [](double PointObservation::*field, double value) {
    PointObservation seen = SomeObservation();
    seen.*field = value;
    return IsValid(seen);
  };
  EXPECT_TRUE(is_valid_with(&PointObservation::depth_m, 0));
  EXPECT_TRUE(is_valid_with(&PointObservation::weight, 0));
  EXPECT_FALSE(is_valid_with(&PointObservation::depth_m, -1));
  EXPECT_FALSE(is_valid_with(&PointObservation::depth_m, nan));
  EXPECT_FALSE(is_valid_with(&PointObservation::weight, -0.1));
  EXPECT_FALSE(is_valid_with(&PointObservation::pixel_sigma, 0));
  EXPECT_FALSE(is_valid_with(&PointObservation::inverse_depth_sigma, 0));
  PointObservation seen = SomeObservation();
  seen.ideal_px.y() = nan;
  EXPECT_FALSE(IsValid(seen));
}

}  // namespace
}  // namespace ofm
