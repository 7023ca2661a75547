// The times of a trajectory.
#pragma once

#include <cstdint>
#include <vector>

#include "ofm/geometry/trajectory.h"

namespace ofm {

inline std::vector<std::int64_t> StampsOf(const Trajectory& trajectory) {
  std::vector<std::int64_t> stamps;
  stamps.reserve(trajectory.size());
  for (const StampedPose& pose : trajectory) stamps.push_back(pose.stamp_ns);
  return stamps;
}

}  // namespace ofm
