#include "ofm/geometry/trajectory.h"

#include <algorithm>

namespace ofm {

std::optional<RigidTransform> InterpolatePose(const Trajectory& trajectory, std::int64_t stamp_ns,
                                              std::int64_t max_gap_ns) {
  const auto after = std::ranges::lower_bound(trajectory, stamp_ns, {}, &StampedPose::stamp_ns);
  if (after == trajectory.end()) return {};
  if (after->stamp_ns == stamp_ns) return after->world_from_camera;
  if (after == trajectory.begin()) return {};
  const StampedPose& before = *(after - 1);
  const std::int64_t gap_ns = after->stamp_ns - before.stamp_ns;
  if (gap_ns > max_gap_ns) return {};
  const double ratio =
      static_cast<double>(stamp_ns - before.stamp_ns) / static_cast<double>(gap_ns);
  return Interpolate(before.world_from_camera, after->world_from_camera, ratio);
}

}  // namespace ofm
