#include "ofm/estimation/pose_system.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ofm/estimation/reprojection.h"
#include "ofm/estimation/test_world.h"

namespace ofm {
namespace {

using test::Depths;

struct Frame {
  PinholeCamera camera = *FindCameraPreset("tum-fr1");
  RigidTransform camera_from_world{ExpSo3(Eigen::Vector3d(0.3, -0.2, 1)),
                                   Eigen::Vector3d(1, 2, -0.5)};
  std::vector<PoseObservation> observations;
  RigidTransform guess;
};

/// With weights, outliers, and a guess beside the truth.
Frame MakeRoughFrame(int count) {
  Frame frame;
  RandomEngine engine = MakeRandomEngine(7, count);
  frame.observations = test::MakeFrame(frame.camera, frame.camera_from_world, count,
                                       Depths::kEverySecond, {}, engine);
  test::Spoil(frame.camera, count / 4, frame.observations, engine);
  for (PoseObservation& o : frame.observations) o.seen.weight = 0.1 + UniformReal(engine);
  frame.guess = ExpSe3(test::RandomTwist(engine, 0.01, 0.005)) * frame.camera_from_world;
  return frame;
}

/// The same sums by the definition, one observation after another.
NormalEquations SumByDefinition(const Frame& frame, const RigidTransform& pose,
                                RobustKernel kernel) {
  NormalEquations sums{Eigen::Matrix<double, 6, 6>::Zero(), Vector6d::Zero(), 0};
  for (const auto& [point_in_world, seen] : frame.observations) {
    const Eigen::Vector3d point = pose * point_in_world;
    const Eigen::Vector3d residual = ReprojectionResidual(frame.camera, point, seen);
    const Eigen::Matrix<double, 3, 6> jacobian =
        ReprojectionJacobian(frame.camera, point, seen) * LeftPerturbationJacobian(point);
    const double chi2 = residual.squaredNorm(), delta = std::sqrt(ChiSquareGate(seen));
    const bool beyond = kernel == RobustKernel::kHuber && chi2 > delta * delta;
    const double weight = seen.weight * (beyond ? delta / std::sqrt(chi2) : 1);
    sums.hessian += weight * jacobian.transpose() * jacobian;
    sums.gradient += weight * jacobian.transpose() * residual;
    sums.cost += 0.5 * seen.weight * (beyond ? 2 * delta * std::sqrt(chi2) - delta * delta : chi2);
  }
  return sums;
}

void ExpectEqual(const NormalEquations& actual, const NormalEquations& expected) {
  EXPECT_LT((actual.hessian - expected.hessian).norm(), 1e-11 * expected.hessian.norm());
  EXPECT_LT((actual.gradient - expected.gradient).norm(), 1e-11 * expected.gradient.norm());
  EXPECT_NEAR(actual.cost, expected.cost, 1e-11 * expected.cost);
}

TEST(PoseSystem, SumsAreThoseOfTheDefinition) {
  for (const int count : {1, 2, 57, 100}) {
    const Frame frame = MakeRoughFrame(count);
    PoseSystem system(frame.camera, frame.observations, 1);
    for (const RobustKernel kernel : {RobustKernel::kNone, RobustKernel::kHuber}) {
      SCOPED_TRACE(count);
      ExpectEqual(system.Linearize(frame.guess, kernel),
                  SumByDefinition(frame, frame.guess, kernel));
    }
  }
}

TEST(PoseSystem, TheGradientIsTheNumericOneOfTheCost) {
  const Frame frame = MakeRoughFrame(80);
  PoseSystem system(frame.camera, frame.observations, 1);
  constexpr double kStep = 1e-6;
  for (const RobustKernel kernel : {RobustKernel::kNone, RobustKernel::kHuber}) {
    const Vector6d gradient = system.Linearize(frame.guess, kernel).gradient;
    for (int i = 0; i < 6; ++i) {
      const Vector6d step = kStep * Vector6d::Unit(i);
      const double above = system.Linearize(ExpSe3(step) * frame.guess, kernel).cost;
      const double below = system.Linearize(ExpSe3(-step) * frame.guess, kernel).cost;
      EXPECT_NEAR((above - below) / 2 / kStep, gradient[i], 1e-5 * gradient.norm()) << i;
    }
  }
}

TEST(PoseSystem, ObservationsOverTheGateSitOutAndMayComeBack) {
  Frame frame = MakeRoughFrame(100);
  PoseSystem system(frame.camera, frame.observations, 1);
  system.Linearize(frame.camera_from_world, RobustKernel::kHuber);
  const auto first = system.ClassifyByGate();
  EXPECT_LT(first.active, 76);
  EXPECT_EQ(first.changed, 100 - first.active);
  for (int i = 0; i < 100; ++i) {
    const auto& [point, seen] = frame.observations[i];
    const double chi2 = ReprojectionChiSquare(frame.camera, frame.camera_from_world * point, seen);
    EXPECT_EQ(system.IsActive(i), chi2 <= ChiSquareGate(seen)) << i;
  }
  const RigidTransform far_off = ExpSe3(Vector6d::Constant(0.3)) * frame.camera_from_world;
  system.Linearize(far_off, RobustKernel::kHuber);
  EXPECT_LT(system.ClassifyByGate().active, 10);
  system.Linearize(frame.camera_from_world, RobustKernel::kHuber);
  EXPECT_EQ(system.ClassifyByGate().active, first.active);
}

TEST(PoseSystem, ThoseThatSitOutAddNothing) {
  Frame frame = MakeRoughFrame(101);
  PoseSystem system(frame.camera, frame.observations, 1);
  system.Linearize(frame.camera_from_world, RobustKernel::kNone);
  system.ClassifyByGate();
  Frame inliers = frame;
  inliers.observations.clear();
  for (int i = 0; i < 101; ++i) {
    if (system.IsActive(i)) inliers.observations.push_back(frame.observations[i]);
  }
  ExpectEqual(system.Linearize(frame.guess, RobustKernel::kNone),
              SumByDefinition(inliers, frame.guess, RobustKernel::kNone));
}

TEST(PoseSystem, TheGateScaleWidensGateAndKernel) {
  const Frame frame = MakeRoughFrame(40);
  PoseSystem narrow(frame.camera, frame.observations, 1);
  PoseSystem wide(frame.camera, frame.observations, 1e9);
  const double plain = narrow.Linearize(frame.guess, RobustKernel::kNone).cost;
  EXPECT_LT(narrow.Linearize(frame.guess, RobustKernel::kHuber).cost, 0.9 * plain);
  EXPECT_EQ(wide.Linearize(frame.guess, RobustKernel::kHuber).cost, plain);
  EXPECT_EQ(wide.ClassifyByGate().active, 40);
}

TEST(PoseSystem, APointBehindTheCameraCostsMuchAndPullsNowhere) {
  Frame frame = MakeRoughFrame(3);
  frame.observations[1].point_in_world = frame.guess.Inverse() * Eigen::Vector3d(0.2, 0.1, -1);
  PoseSystem system(frame.camera, frame.observations, 1);
  const NormalEquations all = system.Linearize(frame.guess, RobustKernel::kHuber);
  EXPECT_GT(all.cost, 1e2);
  EXPECT_FALSE(system.ClassifyByGate().active == 3 || system.IsActive(1));
  frame.observations.erase(frame.observations.begin() + 1);
  const NormalEquations rest = SumByDefinition(frame, frame.guess, RobustKernel::kHuber);
  EXPECT_LT((all.hessian - rest.hessian).norm(), 1e-11 * rest.hessian.norm());
  EXPECT_LT((all.gradient - rest.gradient).norm(), 1e-11 * rest.gradient.norm());
}

}  // namespace
}  // namespace ofm
