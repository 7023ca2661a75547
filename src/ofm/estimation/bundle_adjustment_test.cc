#include "ofm/estimation/bundle_adjustment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "ofm/estimation/bundle_test_world.h"

namespace ofm {
namespace {

using test::BundleWorld;
using test::BundleWorldOptions;
using test::Depths;

constexpr BundleOptions kThorough{.robust_iterations = 20, .final_iterations = 50};

BundleWorld MakeWorld(const BundleWorldOptions& options, std::uint64_t seed = 1) {
  RandomEngine engine = MakeRandomEngine(seed, 0);
  return test::MakeBundleWorld(options, engine);
}

double InitialPositionError_m(const BundleWorld& world) {
  std::vector<RigidTransform> poses;
  for (const auto& pose : world.problem.poses) poses.push_back(pose.camera_from_world);
  return test::PositionError_m(world, poses);
}

double MaxPointError_m(const BundleWorld& world, const BundleResult& result) {
  double error = 0;
  for (std::size_t i = 0; i < result.points_in_world.size(); ++i) {
    const Eigen::Vector3d& truth = world.truth.points_in_world[i];
    error = std::max(error, (result.points_in_world[i] - truth).norm());
  }
  return error;
}

bool SameNumbers(const BundleResult& a, const BundleResult& b) {
  for (std::size_t i = 0; i < a.camera_from_world.size(); ++i) {
    if (a.camera_from_world[i].translation() != b.camera_from_world[i].translation() ||
        a.camera_from_world[i].rotation().coeffs() != b.camera_from_world[i].rotation().coeffs()) {
      return false;
    }
  }
  return a.points_in_world == b.points_in_world && a.inlier == b.inlier &&
         a.final_cost == b.final_cost;
}

TEST(BundleAdjustment, ExactMeasurementsGiveTheTruth) {
  const BundleWorld world = MakeWorld({.noise = {.factor = 0}});
  ASSERT_GT(InitialPositionError_m(world), 0.02);
  const BundleResult result = AdjustBundle(world.camera, world.problem, kThorough);
  EXPECT_TRUE(result.usable);
  EXPECT_GT(result.initial_cost, 1e3);
  EXPECT_LT(result.final_cost, 1e-3);
  EXPECT_LT(test::PositionError_m(world, result.camera_from_world), 1e-4);
  EXPECT_LT(MaxPointError_m(world, result), 1e-3);
  for (const char inlier : result.inlier) EXPECT_TRUE(inlier);
}

TEST(BundleAdjustment, NoiseLeavesAboutTheExpectedCost) {
  const BundleWorld world = MakeWorld({.depths = Depths::kAll});
  const BundleResult result = AdjustBundle(world.camera, world.problem, kThorough);
  const double residuals = 3.0 * static_cast<double>(world.problem.observations.size());
  const double unknowns = 3.0 * 200 + 6.0 * 6;
  EXPECT_NEAR(2 * result.final_cost / (residuals - unknowns), 1, 0.1);
  EXPECT_LT(test::PositionError_m(world, result.camera_from_world),
            0.5 * InitialPositionError_m(world));
}

TEST(BundleAdjustment, WrongObservationsAreFoundAndDoNoHarm) {
  BundleWorld world = MakeWorld({.depths = Depths::kAll});
  const BundleResult clean = AdjustBundle(world.camera, world.problem, kThorough);
  RandomEngine engine = MakeRandomEngine(2, 0);
  test::SpoilEvery(10, world, engine);
  const BundleResult spoilt = AdjustBundle(world.camera, world.problem, kThorough);
  EXPECT_TRUE(spoilt.usable);
  int kept_wrong = 0, lost_right = 0, right = 0;
  for (std::size_t i = 0; i < spoilt.inlier.size(); ++i) {
    kept_wrong += i % 10 == 0 && spoilt.inlier[i];
    lost_right += i % 10 != 0 && !spoilt.inlier[i];
    right += i % 10 != 0;
  }
  EXPECT_LE(kept_wrong, 2);
  EXPECT_LT(lost_right, 0.1 * right);
  EXPECT_LT(test::PositionError_m(world, spoilt.camera_from_world),
            1.5 * test::PositionError_m(world, clean.camera_from_world) + 1e-3);
}

TEST(BundleAdjustment, FixedPosesStayToTheLastBit) {
  const BundleWorld world = MakeWorld({.fixed_poses = 3});
  const BundleResult result = AdjustBundle(world.camera, world.problem, {});
  for (std::size_t i = 0; i < world.problem.poses.size(); ++i) {
    const auto& [before, fixed] = world.problem.poses[i];
    const RigidTransform& after = result.camera_from_world[i];
    const bool same = before.translation() == after.translation() &&
                      before.rotation().coeffs() == after.rotation().coeffs();
    EXPECT_EQ(same, fixed) << i;
  }
}

TEST(BundleAdjustment, TwoCallsGiveTheSameNumbers) {
  BundleWorld world = MakeWorld({});
  RandomEngine engine = MakeRandomEngine(3, 0);
  test::SpoilEvery(15, world, engine);
  const BundleResult a = AdjustBundle(world.camera, world.problem, {});
  const std::vector<char> something_in_between(12345);
  const BundleResult b = AdjustBundle(world.camera, world.problem, {});
  EXPECT_TRUE(SameNumbers(a, b));
}

TEST(BundleAdjustment, ManyPosesAreSolvedSparsely) {
  const BundleWorld world =
      MakeWorld({.free_poses = 70, .points = 400, .views = 8, .noise = {.factor = 0}});
  const BundleResult result = AdjustBundle(world.camera, world.problem, kThorough);
  EXPECT_TRUE(result.usable);
  EXPECT_LT(test::PositionError_m(world, result.camera_from_world), 1e-3);
}

/// The true world, a tenth larger about the only fixed camera.
BundleWorld MakeTooLargeWorld(Depths depths) {
  BundleWorld world = MakeWorld({.fixed_poses = 1, .depths = depths, .noise = {.factor = 0}});
  world.problem = world.truth;
  const Eigen::Vector3d centre = world.truth.poses[0].camera_from_world.Inverse().translation();
  const auto enlarge = [&](const Eigen::Vector3d& p) { return centre + 1.1 * (p - centre); };
  for (Eigen::Vector3d& point : world.problem.points_in_world) point = enlarge(point);
  for (BundleProblem::Pose& pose : world.problem.poses) {
    const RigidTransform world_from_camera = pose.camera_from_world.Inverse();
    const Eigen::Vector3d position = enlarge(world_from_camera.translation());
    pose.camera_from_world = RigidTransform(world_from_camera.rotation(), position).Inverse();
  }
  return world;
}

TEST(BundleAdjustment, DepthGivesTheScaleThatColourAloneCannotKnow) {
  const BundleWorld with = MakeTooLargeWorld(Depths::kEverySecond);
  const BundleWorld without = MakeTooLargeWorld(Depths::kNone);
  const auto error_of = [](const BundleWorld& world) {
    const BundleResult result = AdjustBundle(world.camera, world.problem, kThorough);
    EXPECT_LT(result.final_cost, 1e-2);
    return test::PositionError_m(world, result.camera_from_world);
  };
  EXPECT_GT(InitialPositionError_m(with), 0.05);
  EXPECT_LT(error_of(with), 1e-4);
  EXPECT_NEAR(error_of(without), InitialPositionError_m(without), 1e-6);
}

TEST(BundleAdjustment, DepthsOfWhatIsBehindASilhouetteDoNotStretchTheMap) {
  // As of a structured-light camera, but with sigmas that let the wrong depths pass the gate.
  constexpr double kDepthSigma = 0.03;
  BundleWorld world =
      MakeWorld({.fixed_poses = 1, .depths = Depths::kAll, .noise = {.factor = 0.3}});
  for (auto& o : world.problem.observations) {
    o.seen.inverse_depth_sigma = kDepthSigma;
    if (o.point % 10 == 0) o.seen.depth_m *= 1.15;
  }
  BundleOptions believing = kThorough;
  believing.depth_vetting.max_residual = 1e6;
  const BundleResult stretched = AdjustBundle(world.camera, world.problem, believing);
  const BundleResult vetted = AdjustBundle(world.camera, world.problem, kThorough);
  EXPECT_LT(test::PositionError_m(world, vetted.camera_from_world),
            0.5 * test::PositionError_m(world, stretched.camera_from_world));
  // Their pixels are as good as any.
  int kept = 0, all = 0;
  for (std::size_t i = 0; i < vetted.inlier.size(); ++i) {
    if (world.problem.observations[i].point % 10 != 0) continue;
    kept += vetted.inlier[i];
    ++all;
  }
  EXPECT_GT(kept, 0.9 * all);
}

TEST(BundleAdjustment, WithoutAFixedPoseTheRelativePosesAreFound) {
  const BundleWorld world = MakeWorld({.fixed_poses = 0, .noise = {.factor = 0}});
  const BundleResult result = AdjustBundle(world.camera, world.problem, kThorough);
  EXPECT_TRUE(result.usable);
  const auto& truth = world.truth.poses;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const RigidTransform relative =
        result.camera_from_world[i] * result.camera_from_world[0].Inverse();
    const RigidTransform expected =
        truth[i].camera_from_world * truth[0].camera_from_world.Inverse();
    EXPECT_LT(test::Difference(relative, expected).norm(), 1e-4) << i;
  }
}

TEST(BundleAdjustment, AWeightOfZeroIsAsIfTheObservationWereNotThere) {
  BundleWorld world = MakeWorld({.noise = {.factor = 0}});
  for (std::size_t i = 0; i < world.problem.observations.size(); i += 5) {
    world.problem.observations[i].seen.ideal_px.x() += 30;
    world.problem.observations[i].seen.weight = 0;
  }
  const BundleResult result = AdjustBundle(world.camera, world.problem, kThorough);
  EXPECT_LT(test::PositionError_m(world, result.camera_from_world), 1e-4);
  EXPECT_FALSE(result.inlier[0]);
  EXPECT_TRUE(result.inlier[1]);
}

TEST(BundleAdjustment, PointsHardlySeenBreakNothing) {
  BundleWorld world = MakeWorld({.noise = {.factor = 0}});
  BundleProblem& problem = world.problem;
  const int unseen = static_cast<int>(problem.points_in_world.size());
  const Eigen::Vector3d anywhere(0.1, 0.2, 4);
  for (int i = 0; i < 3; ++i) problem.points_in_world.push_back(anywhere);
  BundleProblem::Observation once;
  once.pose = 4;
  once.point = unseen + 1;  // once without depth
  once.seen.ideal_px = {320, 250};
  problem.observations.push_back(once);
  once.point = unseen + 2;  // once with depth
  once.seen.depth_m = 3.5;
  once.seen.inverse_depth_sigma = 1.4e-3;
  problem.observations.push_back(once);
  const BundleResult result = AdjustBundle(world.camera, problem, kThorough);
  EXPECT_TRUE(result.usable);
  EXPECT_EQ(result.points_in_world[unseen], anywhere);
  EXPECT_EQ(result.points_in_world[unseen + 1], anywhere);
  const Eigen::Vector3d seen_with_depth =
      result.camera_from_world[4] * result.points_in_world[unseen + 2];
  EXPECT_NEAR(seen_with_depth.z(), 3.5, 5e-3);
  EXPECT_LT(test::PositionError_m(world, result.camera_from_world), 1e-4);
}

TEST(BundleAdjustment, PointsBehindACameraAreOutliers) {
  BundleWorld world = MakeWorld({.noise = {.factor = 0}});
  BundleProblem& problem = world.problem;
  BundleProblem::Observation wrong = problem.observations[0];
  wrong.point = static_cast<int>(problem.points_in_world.size());
  problem.points_in_world.emplace_back(0, 0, -5);
  problem.observations.push_back(wrong);
  const BundleResult result = AdjustBundle(world.camera, problem, kThorough);
  EXPECT_TRUE(result.usable);
  EXPECT_FALSE(result.inlier.back());
  EXPECT_EQ(result.points_in_world.back(), Eigen::Vector3d(0, 0, -5));
  EXPECT_LT(test::PositionError_m(world, result.camera_from_world), 1e-4);
}

TEST(BundleAdjustment, NothingToDoIsDone) {
  const PinholeCamera camera;
  const BundleResult nothing = AdjustBundle(camera, {}, {});
  EXPECT_TRUE(nothing.usable);
  EXPECT_EQ(nothing.final_cost, 0);
  BundleWorld world = MakeWorld({.noise = {.factor = 0}});
  world.problem.observations.clear();
  const BundleResult unseen = AdjustBundle(world.camera, world.problem, {});
  EXPECT_TRUE(unseen.usable);
  EXPECT_EQ(unseen.points_in_world, world.problem.points_in_world);
}

TEST(BundleAdjustment, AStopGivesTheStateSoFarAndSaysSo) {
  const BundleWorld world = MakeWorld({});
  std::stop_source stop;
  stop.request_stop();
  const BundleResult result = AdjustBundle(world.camera, world.problem, {}, stop.get_token());
  EXPECT_FALSE(result.usable);
  EXPECT_EQ(result.points_in_world, world.problem.points_in_world);
  EXPECT_EQ(result.camera_from_world.size(), world.problem.poses.size());
  EXPECT_EQ(result.inlier.size(), world.problem.observations.size());
  EXPECT_EQ(result.final_cost, result.initial_cost);
}

TEST(BundleAdjustment, InputThatMakesNoSenseIsTheProgrammersFault) {
  const BundleWorld world = MakeWorld({.points = 20});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect_throw = [&](auto spoil) {
    BundleProblem problem = world.problem;
    spoil(problem);
    EXPECT_THROW(AdjustBundle(world.camera, problem, {}), std::logic_error);
  };
  expect_throw([&](BundleProblem& p) { p.points_in_world[3].x() = nan; });
  expect_throw([&](BundleProblem& p) { p.observations[3].seen.ideal_px.y() = nan; });
  expect_throw([&](BundleProblem& p) { p.observations[3].seen.depth_m = -1; });
  expect_throw([&](BundleProblem& p) { p.observations[3].pose = 100; });
  expect_throw([&](BundleProblem& p) { p.observations[3].point = -1; });
  expect_throw([&](BundleProblem& p) {
    p.poses[1].camera_from_world =
        RigidTransform(Eigen::Quaterniond::Identity(), Eigen::Vector3d(nan, 0, 0));
  });
}

}  // namespace
}  // namespace ofm
