#include "ofm/estimation/pose_graph_cost.h"

#include <gtest/gtest.h>

#include <array>

#include "ofm/estimation/test_world.h"

namespace ofm {
namespace {

constexpr RelativePoseSigma kSigma{0.02, 0.05};

using Residual = Eigen::Matrix<double, 6, 1>;

Residual Evaluate(const RelativePoseCost& cost, const RigidTransform& source,
                  const RigidTransform& target) {
  const double* blocks[] = {source.rotation().coeffs().data(), source.translation().data(),
                            target.rotation().coeffs().data(), target.translation().data()};
  Residual residual;
  EXPECT_TRUE(cost.Evaluate(blocks, residual.data(), nullptr));
  return residual;
}

RigidTransform RandomPose(RandomEngine& engine) {
  return ExpSe3(test::RandomTwist(engine, 1, 0.7));
}

/// One parameter (block, and of that the coordinate) moved by a little.
std::array<RigidTransform, 2> Moved(std::array<RigidTransform, 2> poses, int block, int coordinate,
                                    double step) {
  const Eigen::Vector3d move = step * Eigen::Vector3d::Unit(coordinate);
  RigidTransform& pose = poses[block / 2];
  pose = block % 2 == 0 ? RigidTransform(ExpSo3(move) * pose.rotation(), pose.translation())
                        : RigidTransform(pose.rotation(), pose.translation() + move);
  return poses;
}

TEST(RelativePoseCost, IsZeroWhereThePosesAgreeWithTheMeasurement) {
  RandomEngine engine = MakeRandomEngine(1, 0);
  const RigidTransform source = RandomPose(engine), target = RandomPose(engine);
  const RelativePoseCost cost(target * source.Inverse(), kSigma);
  EXPECT_LT(Evaluate(cost, source, target).norm(), 1e-12);
}

TEST(RelativePoseCost, CountsStandardDeviations) {
  const RelativePoseCost cost(RigidTransform(), kSigma);
  const RigidTransform moved(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.06, 0, 0));
  EXPECT_NEAR(Evaluate(cost, {}, moved)[0], 3, 1e-12);
  const RigidTransform turned(ExpSo3({0, 0.1, 0}), Eigen::Vector3d::Zero());
  EXPECT_NEAR(Evaluate(cost, {}, turned)[4], 2, 1e-12);
}

TEST(RelativePoseCost, JacobiansEqualNumericOnes) {
  constexpr double kStep = 1e-6;
  RandomEngine engine = MakeRandomEngine(2, 0);
  for (const double error : {1e-4, 0.3}) {
    const std::array<RigidTransform, 2> poses = {RandomPose(engine), RandomPose(engine)};
    const RigidTransform wrong = ExpSe3(test::RandomTwist(engine, error, error));
    const RelativePoseCost cost(wrong * poses[1] * poses[0].Inverse(), kSigma);
    Eigen::Matrix<double, 6, 4, Eigen::RowMajor> by_rotation[2];
    Eigen::Matrix<double, 6, 3, Eigen::RowMajor> by_translation[2];
    double* jacobians[] = {by_rotation[0].data(), by_translation[0].data(), by_rotation[1].data(),
                           by_translation[1].data()};
    const double* blocks[] = {poses[0].rotation().coeffs().data(), poses[0].translation().data(),
                              poses[1].rotation().coeffs().data(), poses[1].translation().data()};
    Residual residual;
    ASSERT_TRUE(cost.Evaluate(blocks, residual.data(), jacobians));
    for (int block = 0; block < 4; ++block) {
      for (int i = 0; i < 3; ++i) {
        const auto plus = Moved(poses, block, i, kStep), minus = Moved(poses, block, i, -kStep);
        const Residual numeric =
            (Evaluate(cost, plus[0], plus[1]) - Evaluate(cost, minus[0], minus[1])) / (2 * kStep);
        Residual analytic = by_translation[block / 2].col(i);
        if (block % 2 == 0) analytic = by_rotation[block / 2].col(i);
        EXPECT_LT((numeric - analytic).norm(), 1e-5) << "block " << block << ", " << i;
      }
    }
    for (const auto& jacobian : by_rotation) EXPECT_EQ(jacobian.col(3).norm(), 0);
  }
}

}  // namespace
}  // namespace ofm
