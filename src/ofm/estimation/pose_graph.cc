#include "ofm/estimation/pose_graph.h"

#include <ceres/iteration_callback.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <deque>

#include "ofm/base/check.h"
#include "ofm/estimation/bundle_cost.h"

namespace ofm {
namespace {

void CheckInput(const PoseGraphProblem& problem, const PoseGraphOptions& options) {
  OFM_CHECK(options.iterations >= 1 && options.threads >= 1);
  bool any_fixed = false;
  for (const auto& pose : problem.poses) {
    OFM_CHECK(pose.camera_from_world.IsFinite());
    any_fixed = any_fixed || pose.fixed;
  }
  OFM_CHECK(any_fixed || problem.poses.empty());
  const int poses = static_cast<int>(problem.poses.size());
  for (const auto& edge : problem.edges) {
    OFM_CHECK(edge.source >= 0 && edge.source < poses && edge.target >= 0 && edge.target < poses);
    OFM_CHECK(edge.source != edge.target && edge.target_from_source.IsFinite());
  }
}

/// Poses that a way of edges joins to a fixed one. The others would make the system singular.
std::vector<char> FindHeld(const PoseGraphProblem& problem) {
  std::vector<std::vector<int>> neighbours(problem.poses.size());
  for (const auto& edge : problem.edges) {
    neighbours[edge.source].push_back(edge.target);
    neighbours[edge.target].push_back(edge.source);
  }
  std::vector<char> held(problem.poses.size(), 0);
  std::vector<int> open;
  const auto reach = [&](int pose) {
    if (!held[pose]) open.push_back(pose);
    held[pose] = 1;
  };
  for (std::size_t i = 0; i < problem.poses.size(); ++i) {
    if (problem.poses[i].fixed) reach(static_cast<int>(i));
  }
  while (!open.empty()) {
    const int pose = open.back();
    open.pop_back();
    for (const int neighbour : neighbours[pose]) reach(neighbour);
  }
  return held;
}

class StopCallback final : public ceres::IterationCallback {
 public:
  explicit StopCallback(const std::stop_token& stop) : stop_(stop) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return stop_.stop_requested() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const std::stop_token& stop_;
};

/// The state that Ceres works on, in one array for reproducible results (see BundleState).
struct GraphPose {
  Eigen::Quaterniond rotation;
  Eigen::Vector3d translation;
};

class GraphSolver {
 public:
  explicit GraphSolver(const PoseGraphProblem& problem) : problem_(problem), ceres_(Unowned()) {
    for (const auto& pose : problem.poses) {
      poses_.push_back({pose.camera_from_world.rotation(), pose.camera_from_world.translation()});
    }
    const std::vector<char> held = FindHeld(problem);
    for (const auto& edge : problem.edges) {
      if (held[edge.source]) Add(edge);
    }
  }

  PoseGraphResult Solve(const PoseGraphOptions& options, const std::stop_token& stop) {
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    solver.max_num_iterations = options.iterations;
    solver.num_threads = options.threads;
    solver.logging_type = ceres::SILENT;
    StopCallback callback(stop);
    solver.callbacks.push_back(&callback);
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &ceres_, &summary);
    PoseGraphResult result;
    result.usable = summary.IsSolutionUsable() && !stop.stop_requested();
    result.initial_cost = summary.initial_cost;
    result.final_cost = summary.final_cost;
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const auto& [camera_from_world, fixed] = problem_.poses[i];
      result.camera_from_world.push_back(
          fixed || !result.usable ? camera_from_world
                                  : RigidTransform(poses_[i].rotation, poses_[i].translation));
    }
    return result;
  }

 private:
  static ceres::Problem::Options Unowned() {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  void Add(const PoseGraphProblem::Edge& edge) {
    costs_.emplace_back(edge.target_from_source, edge.sigma);
    GraphPose& source = poses_[edge.source];
    GraphPose& target = poses_[edge.target];
    ceres_.AddResidualBlock(&costs_.back(), nullptr, source.rotation.coeffs().data(),
                            source.translation.data(), target.rotation.coeffs().data(),
                            target.translation.data());
    for (const int index : {edge.source, edge.target}) {
      double* rotation = poses_[index].rotation.coeffs().data();
      ceres_.SetManifold(rotation, &manifold_);
      if (!problem_.poses[index].fixed) continue;
      ceres_.SetParameterBlockConstant(rotation);
      ceres_.SetParameterBlockConstant(poses_[index].translation.data());
    }
  }

  const PoseGraphProblem& problem_;
  std::vector<GraphPose> poses_;
  LeftRotationManifold manifold_;
  std::deque<RelativePoseCost> costs_;
  ceres::Problem ceres_;  ///< after what it points to
};

}  // namespace

PoseGraphResult OptimizePoseGraph(const PoseGraphProblem& problem, const PoseGraphOptions& options,
                                  std::stop_token stop) {
  CheckInput(problem, options);
  return GraphSolver(problem).Solve(options, stop);
}

}  // namespace ofm
