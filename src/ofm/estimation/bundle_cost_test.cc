#include "ofm/estimation/bundle_cost.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ofm/estimation/reprojection.h"
#include "ofm/estimation/test_world.h"

namespace ofm {
namespace {

struct Parameters {
  Eigen::Vector3d point;
  Eigen::Quaterniond rotation;
  Eigen::Vector3d translation;
};

Parameters SomeParameters() {
  return {{0.3, -0.2, 2.5}, ExpSo3(Eigen::Vector3d(0.2, -0.1, 0.4)), {0.1, 0.05, -0.3}};
}

PointObservation SomeObservation() {
  PointObservation seen;
  seen.ideal_px = {330, 200};
  seen.depth_m = 2.1;
  seen.pixel_sigma = 1.2;
  seen.inverse_depth_sigma = 0.004;
  seen.weight = 0.6;
  return seen;
}

Eigen::Vector3d Residual(const ReprojectionCost& cost, const Parameters& p) {
  const double* blocks[] = {p.point.data(), p.rotation.coeffs().data(), p.translation.data()};
  Eigen::Vector3d residual;
  EXPECT_TRUE(cost.Evaluate(blocks, residual.data(), nullptr));
  return residual;
}

struct Jacobians {
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> by_point, by_translation;
  Eigen::Matrix<double, 3, 4, Eigen::RowMajor> by_rotation;
};

Jacobians Differentiate(const ReprojectionCost& cost, const Parameters& p) {
  const double* blocks[] = {p.point.data(), p.rotation.coeffs().data(), p.translation.data()};
  Jacobians j;
  double* jacobians[] = {j.by_point.data(), j.by_rotation.data(), j.by_translation.data()};
  Eigen::Vector3d residual;
  EXPECT_TRUE(cost.Evaluate(blocks, residual.data(), jacobians));
  return j;
}

TEST(ReprojectionCost, IsTheSharedResidualTimesTheRootOfTheWeight) {
  const PinholeCamera camera = *FindCameraPreset("tum-fr1");
  const Parameters p = SomeParameters();
  for (const double depth_m : {0.0, 2.1}) {
    PointObservation seen = SomeObservation();
    seen.depth_m = depth_m;
    const Eigen::Vector3d expected =
        ReprojectionResidual(camera, RigidTransform(p.rotation, p.translation) * p.point, seen);
    const ReprojectionCost cost(camera, seen);
    EXPECT_LT((Residual(cost, p) - std::sqrt(0.6) * expected).norm(), 1e-10);
  }
}

TEST(ReprojectionCost, JacobiansEqualNumericOnes) {
  const PinholeCamera camera = *FindCameraPreset("tum-fr1");
  const ReprojectionCost cost(camera, SomeObservation());
  const Parameters p = SomeParameters();
  const Jacobians jacobians = Differentiate(cost, p);
  const LeftRotationManifold manifold;
  constexpr double kStep = 1e-6;
  const auto numeric = [&](auto move) {
    Parameters above = p, below = p;
    move(above, kStep);
    move(below, -kStep);
    return Eigen::Vector3d((Residual(cost, above) - Residual(cost, below)) / 2 / kStep);
  };
  for (int i = 0; i < 3; ++i) {
    const auto by_point = numeric([&](Parameters& q, double step) { q.point[i] += step; });
    EXPECT_LT((jacobians.by_point.col(i) - by_point).norm(), 1e-6 * by_point.norm()) << i;
    const auto by_translation =
        numeric([&](Parameters& q, double step) { q.translation[i] += step; });
    EXPECT_LT((jacobians.by_translation.col(i) - by_translation).norm(),
              1e-6 * by_translation.norm());
    const auto by_rotation = numeric([&](Parameters& q, double step) {
      const Eigen::Vector3d omega = step * Eigen::Vector3d::Unit(i);
      const Eigen::Quaterniond start = q.rotation;
      manifold.Plus(start.coeffs().data(), omega.data(), q.rotation.coeffs().data());
    });
    EXPECT_LT((jacobians.by_rotation.col(i) - by_rotation).norm(), 1e-6 * by_rotation.norm());
  }
  EXPECT_EQ(jacobians.by_rotation.col(3).norm(), 0);
}

TEST(ReprojectionCost, APointBehindTheCameraIsFarOffAndPullsNowhere) {
  const PinholeCamera camera;
  const ReprojectionCost cost(camera, SomeObservation());
  Parameters p = SomeParameters();
  p.translation.z() = -5;
  EXPECT_EQ(Residual(cost, p).norm(), 1000);
  const Jacobians jacobians = Differentiate(cost, p);
  EXPECT_EQ(jacobians.by_point.norm() + jacobians.by_rotation.norm(), 0);
  EXPECT_EQ(jacobians.by_translation.norm(), 0);
}

TEST(GateHuberLoss, IsQuadraticWithinTheGateAndGoesOnAsItsTangent) {
  PointObservation seen = SomeObservation();
  seen.weight = 1;
  const GateHuberLoss loss(seen);
  double rho[3], above[3];
  loss.Evaluate(5, rho);
  EXPECT_EQ(rho[0], 5);
  EXPECT_EQ(rho[1], 1);
  loss.Evaluate(kChi2Gate3, rho);
  loss.Evaluate(kChi2Gate3 * (1 + 1e-9), above);
  EXPECT_NEAR(above[0], rho[0], 1e-7);
  EXPECT_NEAR(above[1], rho[1], 1e-7);
  loss.Evaluate(4 * kChi2Gate3, rho);
  EXPECT_NEAR(rho[0], 3 * kChi2Gate3, 1e-9);  // 2 * 2 * gate - gate
  EXPECT_NEAR(rho[1], 0.5, 1e-9);
}

TEST(GateHuberLoss, AWeightScalesTheLossOfTheSameResidual) {
  PointObservation seen = SomeObservation();
  seen.weight = 1;
  const GateHuberLoss full(seen);
  seen.weight = 0.25;
  const GateHuberLoss quarter(seen);
  for (const double chi2 : {1.0, 7.0, 8.0, 300.0}) {
    double a[3], b[3];
    full.Evaluate(chi2, a);
    quarter.Evaluate(0.25 * chi2, b);
    EXPECT_NEAR(b[0], 0.25 * a[0], 1e-12) << chi2;
    EXPECT_NEAR(b[1], a[1], 1e-12) << chi2;
  }
}

TEST(LeftRotationManifold, MinusUndoesPlus) {
  const LeftRotationManifold manifold;
  const Eigen::Quaterniond start = SomeParameters().rotation;
  const Eigen::Vector3d omega(0.3, -0.5, 0.2);
  Eigen::Quaterniond moved;
  Eigen::Vector3d difference;
  ASSERT_TRUE(manifold.Plus(start.coeffs().data(), omega.data(), moved.coeffs().data()));
  EXPECT_NEAR(moved.norm(), 1, 1e-15);
  EXPECT_LT((moved.coeffs() - (ExpSo3(omega) * start).coeffs()).norm(), 1e-15);
  ASSERT_TRUE(manifold.Minus(moved.coeffs().data(), start.coeffs().data(), difference.data()));
  EXPECT_LT((difference - omega).norm(), 1e-12);
}

}  // namespace
}  // namespace ofm
