// The rigid transform between two lists of corresponding points.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// The target_from_source that minimises sum w_i |target_i - T source_i|^2, without scale (Umeyama,
/// Least-Squares Estimation of Transformation Parameters Between Two Point Patterns, PAMI 1991,
/// eq. 40 to 43). Both lists have the same length; `weights` (not negative) is empty or has it too.
/// Always a rotation, never a reflection. Empty where the points do not fix the rotation: fewer
/// than three, all in one line, or not finite.
std::optional<RigidTransform> AlignRigid(std::span<const Eigen::Vector3d> source,
                                         std::span<const Eigen::Vector3d> target,
                                         std::span<const double> weights = {});

}  // namespace ofm
