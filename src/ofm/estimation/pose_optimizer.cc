#include "ofm/estimation/pose_optimizer.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "ofm/base/check.h"
#include "ofm/estimation/pose_system.h"

namespace ofm {
namespace {

constexpr int kMinInliers = 3;

/// A round ends where a step would lower the cost (in units of chi-square, so that 1 is one
/// standard deviation) by no more than this.
constexpr double kRobustTolerance = 1e-3;
constexpr double kFinalTolerance = 1e-10;

/// Levenberg–Marquardt with Marquardt's scaling: (H + lambda diag(H)) step = -gradient.
class LevenbergMarquardt {
 public:
  LevenbergMarquardt(PoseSystem& system, RobustKernel kernel, double tolerance)
      : system_(system), kernel_(kernel), tolerance_(tolerance) {}

  /// At most `iterations` steps from `pose`; steps that raise the cost are not taken. The system
  /// is left linearized at the result.
  RigidTransform Minimize(RigidTransform pose, int iterations) {
    NormalEquations equations = system_.Linearize(pose, kernel_);
    bool is_linearized_here = true;
    for (int i = 0; i < iterations; ++i) {
      const Vector6d step = SolveStep(equations);
      const double expected_decrease = -0.5 * equations.gradient.dot(step);
      if (!(expected_decrease > tolerance_)) break;
      const RigidTransform trial = ExpSe3(step) * pose;
      const NormalEquations trial_equations = system_.Linearize(trial, kernel_);
      is_linearized_here = trial_equations.cost < equations.cost;
      if (is_linearized_here) {
        pose = trial;
        equations = trial_equations;
        lambda_ *= kLambdaDecrease;
      } else {
        lambda_ = std::max(kLambdaIncrease * lambda_, kLambdaOfDoubt);
      }
    }
    if (!is_linearized_here) system_.Linearize(pose, kernel_);
    return pose;
  }

 private:
  static constexpr double kInitialLambda = 1e-6, kLambdaDecrease = 0.1;
  static constexpr double kLambdaIncrease = 10, kLambdaOfDoubt = 1e-3;

  Vector6d SolveStep(const NormalEquations& equations) const {
    Eigen::Matrix<double, 6, 6> damped = equations.hessian;
    damped.diagonal() *= 1 + lambda_;
    return damped.ldlt().solve(-equations.gradient);
  }

  PoseSystem& system_;
  RobustKernel kernel_;
  double tolerance_;
  double lambda_ = kInitialLambda;
};

/// True where the information leaves some motion undetermined, whatever its units.
bool IsSingular(const Eigen::Matrix<double, 6, 6>& information) {
  constexpr double kMinPivot = 1e-12;
  if (!(information.diagonal().minCoeff() > 0)) return true;
  const Vector6d scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix<double, 6, 6> unit_diagonal =
      scale.asDiagonal() * information * scale.asDiagonal();
  return !(unit_diagonal.ldlt().vectorD().minCoeff() > kMinPivot);
}

/// Leaves those observations active that are inliers at the pose given back.
RigidTransform OptimizeInRounds(PoseSystem& system, const RigidTransform& initial,
                                std::size_t count, const PoseOptimizerOptions& options) {
  RigidTransform pose = initial;
  if (count < kMinInliers) {
    system.Linearize(pose, RobustKernel::kNone);
    system.ClassifyByGate();
    return pose;
  }
  for (int round = 0; round < options.rounds; ++round) {
    const bool last = round == options.rounds - 1;
    LevenbergMarquardt optimizer(system, last ? RobustKernel::kNone : RobustKernel::kHuber,
                                 last ? kFinalTolerance : kRobustTolerance);
    pose = optimizer.Minimize(pose, options.iterations);
    const auto [active, changed] = system.ClassifyByGate();
    if (active < kMinInliers) break;
    // The same inliers have the same minimum again: only the plain round is left to do.
    if (changed == 0 && !last) round = options.rounds - 2;
  }
  return pose;
}

}  // namespace

PoseEstimate OptimizePose(const PinholeCamera& camera, const RigidTransform& initial,
                          std::span<const PoseObservation> observations,
                          const PoseOptimizerOptions& options) {
  OFM_CHECK(initial.IsFinite());
  OFM_CHECK(options.rounds >= 1 && options.iterations >= 1 && options.gate_scale > 0);
  PoseSystem system(camera, observations, options.gate_scale);
  PoseEstimate result;
  result.camera_from_world = OptimizeInRounds(system, initial, observations.size(), options);

  const NormalEquations equations = system.Linearize(result.camera_from_world, RobustKernel::kNone);
  result.information = equations.hessian;
  result.inlier.resize(observations.size());
  for (std::size_t i = 0; i < observations.size(); ++i) {
    result.inlier[i] = system.IsActive(i);
    result.inlier_count += result.inlier[i];
  }
  result.converged = result.inlier_count >= kMinInliers && !IsSingular(result.information);
  return result;
}

}  // namespace ofm
