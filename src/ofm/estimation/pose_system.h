// The normal equations of a camera's pose, summed two observations at a time.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/estimation/pose_optimizer.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

enum class RobustKernel { kNone, kHuber };

/// Gauss–Newton's system for the left perturbation (rho, omega) of camera_from_world.
struct NormalEquations {
  Eigen::Matrix<double, 6, 6> hessian;  ///< sum of w J^T J
  Vector6d gradient;                    ///< sum of w J^T r
  double cost = 0;                      ///< half the sum of weight times kernel(chi-square)
};

/// Two doubles that are computed with at once: what the baseline of x86-64 and of ARM64 has.
using DoublePair = double __attribute__((vector_size(16)));

/// Holds the observations of a frame in a layout over which a pass is vectorised and allocates
/// nothing.
class PoseSystem {
 public:
  /// `observations` must be valid (see IsValid), their points finite. All are active at first.
  PoseSystem(const PinholeCamera& camera, std::span<const PoseObservation> observations,
             double gate_scale);

  /// Sums the active observations at `camera_from_world` with Huber's weights (threshold: the root
  /// of the gate) or without, and keeps the chi-square of all of them for ClassifyByGate. A point
  /// that is not before the camera costs a large constant while it is active.
  NormalEquations Linearize(const RigidTransform& camera_from_world, RobustKernel kernel);

  struct Classification {
    int active = 0;   ///< observations that are within the gate
    int changed = 0;  ///< of all, those that were of the other kind before
  };
  /// From now on those observations are active whose chi-square in the last Linearize was within
  /// their gate.
  Classification ClassifyByGate();

  bool IsActive(std::size_t i) const { return lanes_[i / 2].active[i % 2] != 0; }

 private:
  struct Lanes {
    DoublePair x, y, z;                       ///< the point in the world
    DoublePair u, v, inverse_depth;           ///< measured, in the normalised image
    DoublePair u_information, v_information;  ///< of these
    DoublePair inverse_depth_information;     ///< 0 without depth
    DoublePair gate, weight;
    DoublePair active;  ///< 1 or 0
    DoublePair chi2;    ///< of the last Linearize
  };
  struct Sums;

  static void Accumulate(Lanes& lanes, const Eigen::Matrix<double, 3, 4>& pose, RobustKernel kernel,
                         Sums& sums);

  std::size_t count_ = 0;
  std::vector<Lanes> lanes_;
};

}  // namespace ofm
