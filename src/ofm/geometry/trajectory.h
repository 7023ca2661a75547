// Poses over time.
#pragma once

#include <cstdint>
#include <vector>

#include "ofm/geometry/rigid_transform.h"

namespace ofm {

struct StampedPose {
  std::int64_t stamp_ns = 0;
  RigidTransform world_from_camera;
};

/// In increasing order of time.
using Trajectory = std::vector<StampedPose>;

}  // namespace ofm
