#include "ofm/estimation/pose_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "ofm/estimation/test_world.h"

namespace ofm {
namespace {

using Edge = PoseGraphProblem::Edge;

/// camera_from_world on a ring of 2 m that looks outwards; `index` of `count`.
RigidTransform RingPose(int index, int count) {
  const double angle = 2 * M_PI * index / count;
  const RigidTransform world_from_camera(ExpSo3({0, angle, 0}),
                                         {2 * std::sin(angle), 0, 2 * std::cos(angle)});
  return world_from_camera.Inverse();
}

/// A way round a ring: odometry whose errors add up, and the poses that it leads to.
struct Ring {
  explicit Ring(int count, double sigma_m = 0.01, double sigma_rad = 0.01) {
    RandomEngine engine = MakeRandomEngine(3, 0);
    for (int i = 0; i < count; ++i) truth.push_back(RingPose(i, count));
    problem.poses.push_back({truth[0], true});
    for (int i = 1; i < count; ++i) {
      const RigidTransform error = ExpSe3(test::RandomTwist(engine, sigma_m, sigma_rad));
      const RigidTransform step = error * truth[i] * truth[i - 1].Inverse();
      problem.edges.push_back({i - 1, i, step, {}});
      problem.poses.push_back({step * problem.poses.back().camera_from_world, false});
    }
  }
  /// What a loop detector would say of the last pose and the first.
  Edge ClosingEdge(double sigma = 0.001) const {
    const int last = static_cast<int>(truth.size()) - 1;
    return {last, 0, truth[0] * truth[last].Inverse(), {sigma, sigma}};
  }
  double Error_m(const RigidTransform& pose, int index) const {
    return (pose.Inverse().translation() - truth[index].Inverse().translation()).norm();
  }

  std::vector<RigidTransform> truth;
  PoseGraphProblem problem;
};

double RmsError_m(const Ring& ring, const std::vector<RigidTransform>& poses) {
  double sum = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    sum += std::pow(ring.Error_m(poses[i], static_cast<int>(i)), 2);
  }
  return std::sqrt(sum / static_cast<double>(poses.size()));
}

TEST(PoseGraph, AClosedLoopTakesMostOfTheDriftAway) {
  Ring ring(40);
  const double drift_m = ring.Error_m(ring.problem.poses.back().camera_from_world, 39);
  ASSERT_GT(drift_m, 0.1) << "before";
  ring.problem.edges.push_back(ring.ClosingEdge());
  std::vector<RigidTransform> before;
  for (const auto& pose : ring.problem.poses) before.push_back(pose.camera_from_world);
  const PoseGraphResult result = OptimizePoseGraph(ring.problem, {});
  EXPECT_TRUE(result.usable);
  EXPECT_LT(result.final_cost, 0.1 * result.initial_cost);
  EXPECT_LT(ring.Error_m(result.camera_from_world.back(), 39), 0.01) << "after";
  EXPECT_LT(RmsError_m(ring, result.camera_from_world), 0.5 * RmsError_m(ring, before));
}

TEST(PoseGraph, ExactEdgesGiveTheTruthFromAnyNearbyStart) {
  Ring ring(12, 0, 0);
  RandomEngine engine = MakeRandomEngine(4, 0);
  for (auto& pose : ring.problem.poses) {
    if (pose.fixed) continue;
    pose.camera_from_world = ExpSe3(test::RandomTwist(engine, 0.2, 0.1)) * pose.camera_from_world;
  }
  ring.problem.edges.push_back(ring.ClosingEdge());
  const PoseGraphResult result = OptimizePoseGraph(ring.problem, {});
  EXPECT_LT(result.final_cost, 1e-6);
  EXPECT_LT(RmsError_m(ring, result.camera_from_world), 1e-6);
}

TEST(PoseGraph, KeepsFixedPosesToTheBit) {
  Ring ring(10);
  ring.problem.edges.push_back(ring.ClosingEdge());
  ring.problem.poses[5].fixed = true;
  const PoseGraphResult result = OptimizePoseGraph(ring.problem, {});
  for (const int fixed : {0, 5}) {
    const RigidTransform& given = ring.problem.poses[fixed].camera_from_world;
    EXPECT_EQ(result.camera_from_world[fixed].translation(), given.translation());
    EXPECT_EQ(result.camera_from_world[fixed].rotation().coeffs(), given.rotation().coeffs());
  }
  EXPECT_NE(result.camera_from_world[1].translation(),
            ring.problem.poses[1].camera_from_world.translation());
}

TEST(PoseGraph, LeavesPosesThatNothingHoldsWhereTheyAre) {
  Ring ring(6);
  const int first = static_cast<int>(ring.problem.poses.size());
  ring.problem.poses.push_back({RingPose(1, 9), false});
  ring.problem.poses.push_back({RingPose(2, 9), false});
  ring.problem.edges.push_back({first, first + 1, RigidTransform(), {}});
  ring.problem.edges.push_back(ring.ClosingEdge());
  const PoseGraphResult result = OptimizePoseGraph(ring.problem, {});
  ASSERT_TRUE(result.usable);
  for (const int loose : {first, first + 1}) {
    EXPECT_EQ(result.camera_from_world[loose].translation(),
              ring.problem.poses[loose].camera_from_world.translation());
  }
  EXPECT_LT(ring.Error_m(result.camera_from_world[5], 5), 0.01);
}

TEST(PoseGraph, TheSameProblemGivesTheSameBits) {
  Ring ring(20);
  ring.problem.edges.push_back(ring.ClosingEdge());
  const PoseGraphResult a = OptimizePoseGraph(ring.problem, {});
  const PoseGraphResult b = OptimizePoseGraph(ring.problem, {});
  for (std::size_t i = 0; i < a.camera_from_world.size(); ++i) {
    EXPECT_EQ(a.camera_from_world[i].translation(), b.camera_from_world[i].translation());
    EXPECT_EQ(a.camera_from_world[i].rotation().coeffs(),
              b.camera_from_world[i].rotation().coeffs());
  }
}

TEST(PoseGraph, GivesTheInputBackWhereItIsStopped) {
  Ring ring(10);
  ring.problem.edges.push_back(ring.ClosingEdge());
  std::stop_source stop;
  stop.request_stop();
  const PoseGraphResult result = OptimizePoseGraph(ring.problem, {}, stop.get_token());
  EXPECT_FALSE(result.usable);
  for (std::size_t i = 0; i < result.camera_from_world.size(); ++i) {
    EXPECT_EQ(result.camera_from_world[i].translation(),
              ring.problem.poses[i].camera_from_world.translation());
  }
}

TEST(PoseGraph, RefusesAGraphThatNothingHolds) {
  Ring ring(4);
  ring.problem.poses[0].fixed = false;
  EXPECT_THROW(OptimizePoseGraph(ring.problem, {}), std::logic_error);
}

TEST(PoseGraph, RefusesAnEdgeToNowhere) {
  Ring ring(4);
  ring.problem.edges[0].target = 4;
  EXPECT_THROW(OptimizePoseGraph(ring.problem, {}), std::logic_error);
}

}  // namespace
}  // namespace ofm
