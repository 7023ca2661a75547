#include "ofm/estimation/pose_optimizer.h"

#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <vector>

#include "ofm/estimation/reprojection.h"
#include "ofm/estimation/test_world.h"

namespace ofm {
namespace {

using test::Depths;
using Frame = std::vector<PoseObservation>;

const PinholeCamera kCamera = *FindCameraPreset("tum-fr3");
const RigidTransform kTruth(ExpSo3(Eigen::Vector3d(0.3, -0.2, 1)), Eigen::Vector3d(1, 2, -0.5));
constexpr test::Noise kExact{.factor = 0};

/// ceres::Solver's numeric differentiation over xi in camera_from_world = Exp(xi) * guess.
struct CeresResidual {
  PoseObservation observation;
  RigidTransform guess;

  bool operator()(const double* xi, double* residual) const {
    const RigidTransform pose = ExpSe3(Eigen::Map<const Vector6d>(xi)) * guess;
    Eigen::Map<Eigen::Vector3d>(residual, 3) =
        ReprojectionResidual(kCamera, pose * observation.point_in_world, observation.seen);
    return true;
  }
};

RigidTransform MinimizeWithCeres(const Frame& frame, const RigidTransform& guess) {
  Vector6d xi = Vector6d::Zero();
  ceres::Problem problem;
  for (const PoseObservation& o : frame) {
    auto* residual = new ceres::NumericDiffCostFunction<CeresResidual, ceres::CENTRAL, 3, 6>(
        new CeresResidual{o, guess});
    auto* weight = new ceres::ScaledLoss(nullptr, o.seen.weight, ceres::TAKE_OWNERSHIP);
    problem.AddResidualBlock(residual, weight, xi.data());
  }
  ceres::Solver::Options options;
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 1e-16;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return ExpSe3(xi) * guess;
}

TEST(PoseOptimizer, ExactMeasurementsGiveTheTruth) {
  RandomEngine engine = MakeRandomEngine(1, 0);
  for (const Depths depths : {Depths::kNone, Depths::kEverySecond, Depths::kAll}) {
    const Frame frame = test::MakeFrame(kCamera, kTruth, 50, depths, kExact, engine);
    const RigidTransform guess = ExpSe3(test::RandomTwist(engine, 0.1, 0.1)) * kTruth;
    const PoseEstimate estimate = OptimizePose(kCamera, guess, frame, {});
    EXPECT_TRUE(estimate.converged);
    EXPECT_EQ(estimate.inlier_count, 50);
    EXPECT_LT(test::Difference(estimate.camera_from_world, kTruth).norm(), 1e-8);
  }
}

TEST(PoseOptimizer, TheMinimumIsThatOfCeres) {
  for (int trial = 0; trial < 5; ++trial) {
    RandomEngine engine = MakeRandomEngine(2, trial);
    Frame frame = test::MakeFrame(kCamera, kTruth, 60, Depths::kEverySecond, {}, engine);
    for (PoseObservation& o : frame) o.seen.weight = 0.1 + UniformReal(engine);
    const RigidTransform guess = ExpSe3(test::RandomTwist(engine, 0.05, 0.05)) * kTruth;
    // One round is the plain one, and this gate keeps everything.
    const PoseEstimate estimate =
        OptimizePose(kCamera, guess, frame, {.rounds = 1, .iterations = 50, .gate_scale = 100});
    const RigidTransform expected = MinimizeWithCeres(frame, guess);
    EXPECT_LT(test::Difference(estimate.camera_from_world, expected).norm(), 1e-6);
    EXPECT_GT(test::Difference(estimate.camera_from_world, kTruth).norm(), 1e-4);
  }
}

TEST(PoseOptimizer, TheLastRoundIsThePlainMinimumOverTheInliers) {
  RandomEngine engine = MakeRandomEngine(3, 0);
  Frame frame = test::MakeFrame(kCamera, kTruth, 200, Depths::kEverySecond, {}, engine);
  test::Spoil(kCamera, 40, frame, engine);
  const RigidTransform guess = ExpSe3(test::RandomTwist(engine, 0.02, 0.02)) * kTruth;
  const PoseEstimate estimate = OptimizePose(kCamera, guess, frame, {.rounds = 10});
  Frame inliers;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (estimate.inlier[i]) inliers.push_back(frame[i]);
  }
  const RigidTransform expected = MinimizeWithCeres(inliers, guess);
  EXPECT_LT(test::Difference(estimate.camera_from_world, expected).norm(), 1e-6);
}

TEST(PoseOptimizer, AThirdOfTheMatchesMayBeWrong) {
  for (int trial = 0; trial < 20; ++trial) {
    RandomEngine engine = MakeRandomEngine(4, trial);
    const Depths depths = trial % 2 ? Depths::kAll : Depths::kNone;
    Frame frame = test::MakeFrame(kCamera, kTruth, 200, depths, {}, engine);
    test::Spoil(kCamera, 60, frame, engine);
    const RigidTransform guess = ExpSe3(test::RandomTwist(engine, 0.03, 0.03)) * kTruth;
    const PoseEstimate estimate = OptimizePose(kCamera, guess, frame, {});
    EXPECT_TRUE(estimate.converged);
    EXPECT_LT(test::Difference(estimate.camera_from_world, kTruth).norm(), 0.01) << trial;
    int kept_wrong = 0, kept_right = 0;
    for (int i = 0; i < 200; ++i) (i < 60 ? kept_wrong : kept_right) += estimate.inlier[i];
    EXPECT_LE(kept_wrong, 2) << trial;
    EXPECT_GE(kept_right, 120) << trial;  // the gate takes 95 % of 140
    EXPECT_EQ(estimate.inlier_count, kept_wrong + kept_right);
  }
}

TEST(PoseOptimizer, PointsBehindTheCameraAreOutliers) {
  RandomEngine engine = MakeRandomEngine(5, 0);
  Frame frame = test::MakeFrame(kCamera, kTruth, 60, Depths::kEverySecond, kExact, engine);
  for (int i = 0; i < 20; ++i) {
    // Mirrored at the camera's centre: the same pixel, but behind.
    const Eigen::Vector3d point = kTruth * frame[i].point_in_world;
    frame[i].point_in_world = kTruth.Inverse() * Eigen::Vector3d(-point);
  }
  const RigidTransform guess = ExpSe3(test::RandomTwist(engine, 0.05, 0.05)) * kTruth;
  const PoseEstimate estimate = OptimizePose(kCamera, guess, frame, {});
  EXPECT_LT(test::Difference(estimate.camera_from_world, kTruth).norm(), 1e-8);
  for (int i = 0; i < 60; ++i) EXPECT_EQ(estimate.inlier[i], i >= 20) << i;
}

TEST(PoseOptimizer, FewerThanThreePointsLeaveThePoseAlone) {
  RandomEngine engine = MakeRandomEngine(6, 0);
  for (int count = 0; count < 3; ++count) {
    Frame frame = test::MakeFrame(kCamera, kTruth, count, Depths::kAll, kExact, engine);
    if (count == 2) frame[1].seen.ideal_px.x() += 50;
    const PoseEstimate estimate = OptimizePose(kCamera, kTruth, frame, {});
    EXPECT_FALSE(estimate.converged);
    EXPECT_EQ(estimate.camera_from_world.translation(), kTruth.translation());
    EXPECT_EQ(estimate.camera_from_world.rotation().coeffs(), kTruth.rotation().coeffs());
    EXPECT_EQ(estimate.inlier.size(), count);
    EXPECT_EQ(estimate.inlier_count, count > 0 ? 1 : 0);
  }
}

TEST(PoseOptimizer, MatchesThatAgreeOnNoPoseDoNotConverge) {
  RandomEngine engine = MakeRandomEngine(7, 0);
  Frame frame = test::MakeFrame(kCamera, kTruth, 8, Depths::kAll, {}, engine);
  test::Spoil(kCamera, 8, frame, engine);
  const PoseEstimate estimate = OptimizePose(kCamera, kTruth, frame, {});
  EXPECT_FALSE(estimate.converged);
  EXPECT_TRUE(estimate.camera_from_world.IsFinite());
}

TEST(PoseOptimizer, PointsInOneLineLeaveARotationOpenAndDoNotConverge) {
  RandomEngine engine = MakeRandomEngine(8, 0);
  Frame frame;
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d point =
        Eigen::Vector3d(-0.5, 0.1, 2) + 0.1 * i * Eigen::Vector3d(1, 0.3, 0.5);
    frame.push_back({point, test::Observe(kCamera, point, kExact, engine)});
  }
  const PoseEstimate estimate = OptimizePose(kCamera, RigidTransform(), frame, {});
  EXPECT_EQ(estimate.inlier_count, 10);
  EXPECT_FALSE(estimate.converged);
  EXPECT_TRUE(estimate.camera_from_world.IsFinite());
}

TEST(PoseOptimizer, WeightsSayWhomToBelieve) {
  RandomEngine engine = MakeRandomEngine(9, 0);
  Frame frame = test::MakeFrame(kCamera, kTruth, 60, Depths::kNone, kExact, engine);
  // Half of the image went 1 px to the right; within the gate, so that weights alone decide.
  for (int i = 0; i < 30; ++i) frame[i].seen.ideal_px.x() += 1;
  const auto error_with = [&](double weight) {
    for (int i = 0; i < 30; ++i) frame[i].seen.weight = weight;
    const PoseEstimate estimate = OptimizePose(kCamera, kTruth, frame, {});
    EXPECT_TRUE(estimate.converged);
    EXPECT_EQ(estimate.inlier_count, 60);
    return test::Difference(estimate.camera_from_world, kTruth).norm();
  };
  const double equal = error_with(1);
  EXPECT_GT(equal, 5e-4);
  EXPECT_LT(error_with(0.1), 0.5 * equal);
  EXPECT_LT(error_with(0), 1e-8);
}

TEST(PoseOptimizer, AllWeightsZeroDoNotConverge) {
  RandomEngine engine = MakeRandomEngine(10, 0);
  Frame frame = test::MakeFrame(kCamera, kTruth, 20, Depths::kAll, {}, engine);
  for (PoseObservation& o : frame) o.seen.weight = 0;
  EXPECT_FALSE(OptimizePose(kCamera, kTruth, frame, {}).converged);
}

TEST(PoseOptimizer, TheInformationPredictsTheSpread) {
  constexpr int kTrials = 200;
  double sum = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    RandomEngine engine = MakeRandomEngine(11, trial);
    const Frame frame = test::MakeFrame(kCamera, kTruth, 100, Depths::kEverySecond, {}, engine);
    const RigidTransform guess = ExpSe3(test::RandomTwist(engine, 0.02, 0.02)) * kTruth;
    // A gate without effect: cutting the tails would narrow the spread.
    const PoseEstimate estimate = OptimizePose(kCamera, guess, frame, {.gate_scale = 10});
    const Vector6d error = test::Difference(estimate.camera_from_world, kTruth);
    sum += error.dot(estimate.information * error);
  }
  // The mean of 200 chi-squares with 6 degrees of freedom: 6 +- 0.245 per standard deviation.
  EXPECT_NEAR(sum / kTrials, 6, 4 * 0.245);
}

TEST(PoseOptimizer, DepthNarrowsTheTranslationAlongTheView) {
  RandomEngine engine = MakeRandomEngine(12, 0);
  Frame frame = test::MakeFrame(kCamera, kTruth, 100, Depths::kAll, {}, engine);
  const double with = OptimizePose(kCamera, kTruth, frame, {}).information(2, 2);
  for (PoseObservation& o : frame) o.seen.depth_m = 0;
  EXPECT_GT(with, 2 * OptimizePose(kCamera, kTruth, frame, {}).information(2, 2));
}

TEST(PoseOptimizer, TheSameCallGivesTheSameNumbers) {
  RandomEngine engine = MakeRandomEngine(13, 0);
  Frame frame = test::MakeFrame(kCamera, kTruth, 101, Depths::kEverySecond, {}, engine);
  test::Spoil(kCamera, 30, frame, engine);
  const PoseEstimate a = OptimizePose(kCamera, kTruth, frame, {});
  const PoseEstimate b = OptimizePose(kCamera, kTruth, frame, {});
  EXPECT_EQ(a.camera_from_world.translation(), b.camera_from_world.translation());
  EXPECT_EQ(a.camera_from_world.rotation().coeffs(), b.camera_from_world.rotation().coeffs());
  EXPECT_EQ(a.information, b.information);
  EXPECT_EQ(a.inlier, b.inlier);
}

TEST(PoseOptimizer, NumbersThatAreNoneAreTheProgrammersFault) {
  RandomEngine engine = MakeRandomEngine(14, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Frame frame = test::MakeFrame(kCamera, kTruth, 5, Depths::kAll, {}, engine);
  const RigidTransform bad(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, nan, 0));
  EXPECT_THROW(OptimizePose(kCamera, bad, frame, {}), std::logic_error);
  frame[4].point_in_world.z() = nan;
  EXPECT_THROW(OptimizePose(kCamera, kTruth, frame, {}), std::logic_error);
}

}  // namespace
}  // namespace ofm
