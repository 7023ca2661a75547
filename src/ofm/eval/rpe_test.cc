#include "ofm/eval/rpe.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ofm/base/error.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

/// A pose every 0.1 s on a curve with turns.
Trajectory Curve(int count) {
  Trajectory trajectory;
  for (int i = 0; i < count; ++i) {
    const double t = 0.1 * i;
    trajectory.push_back(
        {i * 100'000'000LL, {ExpSo3({0.1 * t, std::sin(t), 0.2}), {t, std::cos(t), 0.3 * t}}});
  }
  return trajectory;
}

/// `trajectory` where the camera drifts by `step` in its own frame from each pose to the next.
Trajectory WithDrift(const Trajectory& trajectory, const RigidTransform& step) {
  Trajectory drifted = {trajectory[0]};
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const RigidTransform motion =
        trajectory[i - 1].world_from_camera.Inverse() * trajectory[i].world_from_camera;
    drifted.push_back({trajectory[i].stamp_ns, drifted.back().world_from_camera * motion * step});
  }
  return drifted;
}

TEST(Rpe, IsZeroForTheTruthInAnyWorld) {
  const Trajectory truth = Curve(30);
  Trajectory moved;
  const RigidTransform other_from_world(ExpSo3({1, 2, 0.5}), {3, -4, 5});
  for (const auto& [stamp_ns, pose] : truth) moved.push_back({stamp_ns, other_from_world * pose});
  for (const RpePairs pairs : {RpePairs::kConsecutive, RpePairs::kFixedDelta, RpePairs::kAll}) {
    const RpeResult rpe = ComputeRpe(moved, truth, {.pairs = pairs});
    EXPECT_GT(rpe.translation_m.count, 0u);
    EXPECT_LT(rpe.translation_m.max, 1e-12);
    EXPECT_LT(rpe.rotation_deg.max, 1e-6);
  }
}

TEST(Rpe, ConsecutivePairsMeasureTheDriftPerFrame) {
  const Trajectory truth = Curve(30);
  const RigidTransform step(ExpSo3({0, 0, 0.01}), {0.003, 0, 0.004});
  const RpeResult rpe =
      ComputeRpe(WithDrift(truth, step), truth, {.pairs = RpePairs::kConsecutive});
  EXPECT_EQ(rpe.translation_m.count, 28u);  // the last pose ends no pair, as in the tool
  EXPECT_NEAR(rpe.rotation_deg.min, 0.01 * 180 / M_PI, 1e-9);
  EXPECT_NEAR(rpe.rotation_deg.max, 0.01 * 180 / M_PI, 1e-9);
  EXPECT_GT(rpe.translation_m.rmse, 0.003);
  EXPECT_LT(rpe.translation_m.rmse, 0.01);
}

TEST(Rpe, PureTranslationDriftIsExactInEveryPair) {
  Trajectory truth = Curve(30);
  for (StampedPose& pose : truth) {
    pose.world_from_camera = {Eigen::Quaterniond::Identity(), pose.world_from_camera.translation()};
  }
  const Trajectory estimate = WithDrift(truth, {Eigen::Quaterniond::Identity(), {0.003, 0, 0.004}});
  const auto rmse = [&](RpePairs pairs, double delta_s) {
    return ComputeRpe(estimate, truth, {.pairs = pairs, .delta_s = delta_s}).translation_m.rmse;
  };
  EXPECT_NEAR(rmse(RpePairs::kConsecutive, 1), 0.005, 1e-12);
  EXPECT_NEAR(rmse(RpePairs::kFixedDelta, 1), 0.05, 1e-12);
  EXPECT_NEAR(rmse(RpePairs::kFixedDelta, 0.5), 0.025, 1e-12);
  // Over all pairs of n poses the mean square distance |i - j| is (n^2 - 1) / 6.
  EXPECT_NEAR(rmse(RpePairs::kAll, 1), 0.005 * std::sqrt((900 - 1) / 6.0), 1e-12);
}

TEST(Rpe, FixedDeltaTakesTheNearestPoseAndNotTheLast) {
  // 30 poses of 0.1 s: i = 0..18 have a partner one second later that is not pose 29.
  EXPECT_EQ(ComputeRpe(Curve(30), Curve(30)).translation_m.count, 19u);
}

TEST(Rpe, PosesWithoutTruthNearbyAreLeftOut) {
  const Trajectory estimate = Curve(30);
  Trajectory truth = estimate;
  truth.erase(truth.begin() + 10, truth.begin() + 20);  // a gap of 1.1 s; intervals of 0.1 s
  const RpeResult rpe = ComputeRpe(estimate, truth, {.pairs = RpePairs::kConsecutive});
  // Poses 10, 11, 18 and 19 are still within 0.2 s of a true one; 12 to 17 are not.
  EXPECT_EQ(rpe.translation_m.count, 28u - 7u);
}

TEST(Rpe, DrawnPairsAreSeededAndCloseToAll) {
  const Trajectory truth = Curve(100);
  const Trajectory estimate = WithDrift(truth, {ExpSo3({0, 0, 0.001}), {0.003, 0, 0.004}});
  const auto rmse = [&](std::size_t max_pairs, std::uint64_t seed) {
    const RpeResult rpe = ComputeRpe(
        estimate, truth, {.pairs = RpePairs::kAll, .max_pairs = max_pairs, .seed = seed});
    EXPECT_EQ(rpe.translation_m.count, max_pairs == 0 ? 10'000u : max_pairs);
    return rpe.translation_m.rmse;
  };
  const double all = rmse(0, 0);
  EXPECT_EQ(rmse(10'000, 5), all);
  EXPECT_EQ(rmse(5'000, 1), rmse(5'000, 1));
  EXPECT_NE(rmse(5'000, 1), rmse(5'000, 2));
  EXPECT_NEAR(rmse(5'000, 1), all, 0.03 * all);
}

TEST(Rpe, WithoutAPairTheCountIsZero) {
  EXPECT_EQ(ComputeRpe(Curve(5), Curve(30)).translation_m.count, 0u);  // shorter than 1 s
  EXPECT_EQ(ComputeRpe({}, Curve(30), {.pairs = RpePairs::kAll}).translation_m.count, 0u);
  EXPECT_EQ(ComputeRpe({}, Curve(30)).translation_m.count, 0u);
  EXPECT_EQ(ComputeRpe({}, Curve(30), {.pairs = RpePairs::kConsecutive}).rotation_deg.count, 0u);
}

TEST(MotionErrors, AreThoseOfTheStatisticsInOrderOfTime) {
  const Trajectory truth = Curve(30);
  const Trajectory estimate = WithDrift(truth, {ExpSo3({0, 0, 0.01}), {0.003, 0, 0.004}});
  for (const RpePairs pairs : {RpePairs::kConsecutive, RpePairs::kFixedDelta}) {
    const RpeOptions options = {.pairs = pairs, .delta_s = 0.5};
    const RpeResult rpe = ComputeRpe(estimate, truth, options);
    const std::vector<MotionError> errors = ComputeMotionErrors(estimate, truth, options);
    std::vector<double> translations_m, rotations_deg;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      EXPECT_EQ(errors[i].stamp_ns, estimate[i].stamp_ns);
      translations_m.push_back(errors[i].translation_m);
      rotations_deg.push_back(errors[i].rotation_deg);
    }
    EXPECT_EQ(ComputeStatistics(translations_m).rmse, rpe.translation_m.rmse);
    EXPECT_EQ(ComputeStatistics(rotations_deg).max, rpe.rotation_deg.max);
  }
}

TEST(MotionErrors, ArePairsInTime) {
  EXPECT_THROW(ComputeMotionErrors(Curve(5), Curve(5), {.pairs = RpePairs::kAll}),
               std::logic_error);
  EXPECT_TRUE(ComputeMotionErrors({}, Curve(5)).empty());
}

TEST(Rpe, WantsGroundTruth) {
  EXPECT_EQ(ErrorOf([] { ComputeRpe(Curve(5), Curve(1)); }),
            "the ground truth holds fewer than 2 poses");
}

}  // namespace
}  // namespace ofm
