#include "ofm/estimation/bundle_adjustment.h"

#include <ceres/iteration_callback.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>

#include "ofm/base/check.h"
#include "ofm/estimation/bundle_cost.h"
#include "ofm/estimation/reprojection.h"

namespace ofm {
namespace {

/// Over this number of free poses the reduced camera system is factorised as a sparse one.
constexpr int kMaxDensePoses = 60;

/// A stage ends where an iteration lowers the cost by less than this for each observation. Not a
/// share of the cost, most of which outliers make.
constexpr double kRobustTolerance = 1e-2, kFinalTolerance = 1e-5;

enum class Stage { kRobust, kFinal };

void CheckInput(const BundleProblem& problem, const BundleOptions& options) {
  OFM_CHECK(options.robust_iterations >= 0 && options.final_iterations >= 0);
  OFM_CHECK(options.threads >= 1);
  for (const auto& pose : problem.poses) OFM_CHECK(pose.camera_from_world.IsFinite());
  for (const auto& point : problem.points_in_world) OFM_CHECK(point.allFinite());
  const int poses = static_cast<int>(problem.poses.size());
  const int points = static_cast<int>(problem.points_in_world.size());
  for (const auto& o : problem.observations) {
    OFM_CHECK(o.pose >= 0 && o.pose < poses && o.point >= 0 && o.point < points);
    OFM_CHECK(IsValid(o.seen));
  }
}

/// Ends the solver where a stop is requested or an iteration gained too little.
class EndCallback final : public ceres::IterationCallback {
 public:
  EndCallback(const std::stop_token& stop, double min_decrease)
      : stop_(stop), min_decrease_(min_decrease) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& iteration) override {
    const bool gained_little = iteration.iteration > 0 && iteration.step_is_successful &&
                               iteration.cost_change < min_decrease_;
    // Not SOLVER_ABORT: that would throw the best state away.
    return stop_.stop_requested() || gained_little ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                                   : ceres::SOLVER_CONTINUE;
  }

 private:
  const std::stop_token& stop_;
  double min_decrease_;
};

/// The state that Ceres works on. Ceres orders blocks by their address, so that contiguous arrays
/// make the order, and with it the result's last bits, reproducible.
struct BundleState {
  struct Pose {
    Eigen::Quaterniond rotation;
    Eigen::Vector3d translation;
  };
  std::vector<Pose> poses;
  std::vector<Eigen::Vector3d> points;

  explicit BundleState(const BundleProblem& problem) : points(problem.points_in_world) {
    for (const auto& [pose, fixed] : problem.poses) {
      poses.push_back({pose.rotation(), pose.translation()});
    }
  }

  std::vector<RigidTransform> CameraFromWorld() const {
    std::vector<RigidTransform> result;
    result.reserve(poses.size());
    for (const auto& [rotation, translation] : poses) result.emplace_back(rotation, translation);
    return result;
  }

  Eigen::Vector3d PointInCamera(const BundleProblem::Observation& o) const {
    return poses[o.pose].rotation * points[o.point] + poses[o.pose].translation;
  }
};

/// The problem without the depths that parallax contradicts in `state`.
BundleProblem Vetted(const PinholeCamera& camera, const BundleProblem& problem,
                     const BundleState& state, const DepthVettingOptions& options) {
  const std::vector<char> contradicted = FindContradictedDepths(
      camera, state.CameraFromWorld(), state.points, problem.observations, options);
  BundleProblem vetted = problem;
  for (auto& o : vetted.observations) {
    if (contradicted[o.point]) o.seen.depth_m = 0;
  }
  return vetted;
}

/// Chi-squares of all observations.
std::vector<double> ChiSquares(const PinholeCamera& camera, const BundleProblem& problem,
                               const BundleState& state) {
  std::vector<double> chi2;
  chi2.reserve(problem.observations.size());
  for (const auto& o : problem.observations) {
    chi2.push_back(ReprojectionChiSquare(camera, state.PointInCamera(o), o.seen));
  }
  return chi2;
}

double RobustCost(const BundleProblem& problem, const std::vector<double>& chi2) {
  constexpr double kBehindChiSquare = 1e6;
  double sum = 0;
  for (std::size_t i = 0; i < chi2.size(); ++i) {
    const PointObservation& seen = problem.observations[i].seen;
    double rho[3];
    GateHuberLoss(seen).Evaluate(seen.weight * std::min(chi2[i], kBehindChiSquare), rho);
    sum += rho[0];
  }
  return 0.5 * sum;
}

/// Marks the good observations that say something: not a point's only one, where that has no
/// depth.
template <class IsGood>
std::vector<char> ChooseActive(const BundleProblem& problem, IsGood is_good) {
  const std::size_t count = problem.observations.size();
  std::vector<char> active(count);
  std::vector<int> constraints(problem.points_in_world.size(), 0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& o = problem.observations[i];
    active[i] = o.seen.weight > 0 && is_good(i);
    if (active[i]) constraints[o.point] += HasDepth(o.seen) ? 3 : 2;
  }
  for (std::size_t i = 0; i < count; ++i) {
    active[i] = active[i] && constraints[problem.observations[i].point] >= 3;
  }
  return active;
}

ceres::Solver::Options SolverOptions(const BundleProblem& problem, const BundleOptions& options,
                                     Stage stage) {
  ceres::Solver::Options result;
  const auto free_poses = std::count_if(problem.poses.begin(), problem.poses.end(),
                                        [](const auto& pose) { return !pose.fixed; });
  result.linear_solver_type =
      free_poses > kMaxDensePoses ? ceres::SPARSE_SCHUR : ceres::DENSE_SCHUR;
  result.max_num_iterations =
      stage == Stage::kRobust ? options.robust_iterations : options.final_iterations;
  result.num_threads = options.threads;
  result.jacobi_scaling = false;  // Marquardt scales already
  result.logging_type = ceres::SILENT;
  return result;
}

class StageSolver {
 public:
  StageSolver(const PinholeCamera& camera, const BundleProblem& problem, Stage stage,
              const std::vector<char>& active, BundleState& state)
      : problem_(problem), stage_(stage), state_(state), ceres_(ProblemOptions()) {
    for (std::size_t i = 0; i < active.size(); ++i) {
      if (active[i]) Add(camera, problem.observations[i]);
    }
  }

  /// False where the solver failed; the state is then as before.
  bool Solve(ceres::Solver::Options options, const std::stop_token& stop) {
    options.linear_solver_ordering = Ordering();
    const double tolerance = stage_ == Stage::kRobust ? kRobustTolerance : kFinalTolerance;
    EndCallback callback(stop, tolerance * static_cast<double>(costs_.size()));
    options.callbacks.push_back(&callback);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &ceres_, &summary);
    return summary.IsSolutionUsable();
  }

 private:
  static ceres::Problem::Options ProblemOptions() {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.disable_all_safety_checks = true;
    return options;
  }

  void Add(const PinholeCamera& camera, const BundleProblem::Observation& o) {
    costs_.emplace_back(camera, o.seen);
    ceres::LossFunction* loss = nullptr;
    if (stage_ == Stage::kRobust) loss = &losses_.emplace_back(o.seen);
    BundleState::Pose& pose = state_.poses[o.pose];
    double* rotation = pose.rotation.coeffs().data();
    double* translation = pose.translation.data();
    const bool is_new = !ceres_.HasParameterBlock(rotation);
    ceres_.AddResidualBlock(&costs_.back(), loss, state_.points[o.point].data(), rotation,
                            translation);
    if (!is_new) return;
    ceres_.SetManifold(rotation, &manifold_);
    if (problem_.poses[o.pose].fixed) {
      ceres_.SetParameterBlockConstant(rotation);
      ceres_.SetParameterBlockConstant(translation);
    }
  }

  /// Points are eliminated first.
  std::shared_ptr<ceres::ParameterBlockOrdering> Ordering() {
    auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (Eigen::Vector3d& point : state_.points) {
      if (ceres_.HasParameterBlock(point.data())) ordering->AddElementToGroup(point.data(), 0);
    }
    for (BundleState::Pose& pose : state_.poses) {
      double* rotation = pose.rotation.coeffs().data();
      if (!ceres_.HasParameterBlock(rotation)) continue;
      ordering->AddElementToGroup(rotation, 1);
      ordering->AddElementToGroup(pose.translation.data(), 1);
    }
    return ordering;
  }

  const BundleProblem& problem_;
  const Stage stage_;
  BundleState& state_;
  LeftRotationManifold manifold_;
  std::deque<ReprojectionCost> costs_;
  std::deque<GateHuberLoss> losses_;
  ceres::Problem ceres_;  ///< after what it points to
};

}  // namespace

BundleResult AdjustBundle(const PinholeCamera& camera, const BundleProblem& problem,
                          const BundleOptions& options, std::stop_token stop) {
  CheckInput(problem, options);
  BundleState state(problem);
  BundleProblem vetted = Vetted(camera, problem, state, options.depth_vetting);
  BundleResult result;
  std::vector<double> chi2 = ChiSquares(camera, vetted, state);
  result.initial_cost = RobustCost(vetted, chi2);

  const auto is_inlier = [&](std::size_t i) {
    return chi2[i] <= ChiSquareGate(vetted.observations[i].seen);
  };
  result.usable = true;
  for (const Stage stage : {Stage::kRobust, Stage::kFinal}) {
    const ceres::Solver::Options solver_options = SolverOptions(vetted, options, stage);
    if (stop.stop_requested() || !result.usable || solver_options.max_num_iterations == 0) continue;
    const auto is_good = [&](std::size_t i) {
      return stage == Stage::kRobust ? std::isfinite(chi2[i]) : is_inlier(i);
    };
    StageSolver solver(camera, vetted, stage, ChooseActive(vetted, is_good), state);
    result.usable = solver.Solve(solver_options, stop);
    if (stage == Stage::kRobust) vetted = Vetted(camera, problem, state, options.depth_vetting);
    chi2 = ChiSquares(camera, vetted, state);
  }
  result.usable = result.usable && !stop.stop_requested();
  result.final_cost = RobustCost(vetted, chi2);

  result.camera_from_world = state.CameraFromWorld();
  for (std::size_t i = 0; i < problem.poses.size(); ++i) {
    const auto& [camera_from_world, fixed] = problem.poses[i];
    if (fixed) result.camera_from_world[i] = camera_from_world;
  }
  result.points_in_world = std::move(state.points);
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    result.inlier.push_back(is_inlier(i));
  }
  return result;
}

}  // namespace ofm
