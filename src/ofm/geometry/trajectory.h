// Poses over time.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "ofm/geometry/rigid_transform.h"

namespace ofm {

struct StampedPose {
  std::int64_t stamp_ns = 0;
  RigidTransform world_from_camera;
};

/// In increasing order of time.
using Trajectory = std::vector<StampedPose>;

/// world_from_camera at a time, between the two poses next to it; empty before the first, after the
/// last, and where the two are more than `max_gap_ns` apart.
std::optional<RigidTransform> InterpolatePose(
    const Trajectory& trajectory, std::int64_t stamp_ns,
    std::int64_t max_gap_ns = std::numeric_limits<std::int64_t>::max());

}  // namespace ofm
