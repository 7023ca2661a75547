// What pose-graph optimisation gives to Ceres.
#pragma once

#include <ceres/sized_cost_function.h>

#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// How sure the measurement of a relative pose is: standard deviations.
struct RelativePoseSigma {
  double translation_m = 0.01;
  double rotation_rad = 0.01;
};

/// Six residuals, in standard deviations: by how much target_from_source of two poses differs from
/// the measured one, in translation and, as LogSo3(predicted * measured^-1), in rotation. Of four
/// parameter blocks: rotation of source_from_world as a unit quaternion (x, y, z, w), its
/// translation [m], and the same of target_from_world. Derivatives by rotations are those of
/// ReprojectionCost: for LeftRotationManifold.
class RelativePoseCost final : public ceres::SizedCostFunction<6, 4, 3, 4, 3> {
 public:
  RelativePoseCost(const RigidTransform& target_from_source, const RelativePoseSigma& sigma);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  RigidTransform measured_;
  double translation_scale_, rotation_scale_;  ///< 1 / standard deviation [1/m, 1/rad]
};

}  // namespace ofm
