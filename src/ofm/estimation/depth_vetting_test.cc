#include "ofm/estimation/depth_vetting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "ofm/estimation/bundle_test_world.h"

namespace ofm {
namespace {

using test::BundleWorld;
using test::Depths;

BundleWorld MakeWorld() {
  RandomEngine engine = MakeRandomEngine(1, 0);
  return test::MakeBundleWorld({.depths = Depths::kAll}, engine);
}

/// What `problem` shows at its own poses and points.
std::vector<char> FindIn(const PinholeCamera& camera, const BundleProblem& problem,
                         const DepthVettingOptions& options = {}) {
  std::vector<RigidTransform> poses;
  for (const auto& pose : problem.poses) poses.push_back(pose.camera_from_world);
  return FindContradictedDepths(camera, poses, problem.points_in_world, problem.observations,
                                options);
}

int Count(const std::vector<char>& flags) {
  return static_cast<int>(std::count(flags.begin(), flags.end(), 1));
}

/// Gives the depths of every `step`-th point a factor.
void ScaleDepths(int step, double factor, BundleProblem& problem) {
  for (auto& o : problem.observations) {
    if (o.point % step == 0) o.seen.depth_m *= factor;
  }
}

TEST(FindContradictedDepths, FindsThePointsWhoseDepthIsThatOfSomethingElse) {
  BundleWorld world = MakeWorld();
  EXPECT_EQ(Count(FindIn(world.camera, world.truth)), 0);
  ScaleDepths(10, 1.2, world.truth);
  const std::vector<char> found = FindIn(world.camera, world.truth);
  ASSERT_EQ(found.size(), world.truth.points_in_world.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i] != 0, i % 10 == 0) << i;
}

TEST(FindContradictedDepths, BelievesDepthWhereTheCameraOnlyTurns) {
  BundleWorld world = MakeWorld();
  ScaleDepths(10, 1.2, world.truth);
  for (auto& pose : world.truth.poses) {
    pose.camera_from_world =
        RigidTransform(pose.camera_from_world.rotation(), Eigen::Vector3d::Zero());
  }
  EXPECT_EQ(Count(FindIn(world.camera, world.truth)), 0);
}

TEST(FindContradictedDepths, ACommonScaleCondemnsNobody) {
  BundleWorld world = MakeWorld();
  ScaleDepths(1, 1 / 1.2, world.truth);
  EXPECT_EQ(Count(FindIn(world.camera, world.truth)), 0);
  ScaleDepths(10, 1.2, world.truth);
  EXPECT_EQ(Count(FindIn(world.camera, world.truth)), 20);
}

TEST(FindContradictedDepths, OneWrongDepthAmongManyCondemnsNoPoint) {
  BundleWorld world = MakeWorld();
  constexpr int kMoreViews = 9;
  auto& observations = world.truth.observations;
  const BundleProblem::Observation seen = observations[0];
  for (int i = 0; i < kMoreViews; ++i) observations.push_back(seen);
  observations.back().seen.depth_m = 0.5;
  EXPECT_EQ(Count(FindIn(world.camera, world.truth)), 0);
}

TEST(FindContradictedDepths, WhatHasNoWeightDoesNotCount) {
  BundleWorld world = MakeWorld();
  ScaleDepths(10, 1.2, world.truth);
  for (auto& o : world.truth.observations) {
    if (o.point % 10 == 0) o.seen.weight = 0;
  }
  EXPECT_EQ(Count(FindIn(world.camera, world.truth)), 0);
}

TEST(FindContradictedDepths, LimitsDecide) {
  BundleWorld world = MakeWorld();
  ScaleDepths(10, 1.2, world.truth);
  EXPECT_EQ(Count(FindIn(world.camera, world.truth, {.max_residual = 1})), 0);
  EXPECT_EQ(Count(FindIn(world.camera, world.truth, {.max_parallax_sigma = 1e-5})), 0);
}

TEST(FindContradictedDepths, PointsThatNobodySeesAreAllRight) {
  const BundleWorld world = MakeWorld();
  BundleProblem problem = world.truth;
  problem.observations.clear();
  EXPECT_EQ(Count(FindIn(world.camera, problem)), 0);
  EXPECT_TRUE(FindIn(world.camera, {}).empty());
}

}  // namespace
}  // namespace ofm
