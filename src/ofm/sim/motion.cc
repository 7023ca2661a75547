#include "ofm/sim/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ofm/base/check.h"

namespace ofm {
namespace {

Eigen::Quaterniond Yaw(double yaw_rad) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
}

RigidTransform At(const StaticMotion& motion, double) { return motion.world_from_body; }

RigidTransform At(const SweepMotion& motion, double time_s) {
  constexpr double kTurnSharpness = 6;  // the half turn at each end takes about a tenth of a period
  const double angle = 2 * std::numbers::pi * time_s / motion.period_s + motion.phase_rad;
  const double forward_yaw = std::atan2(motion.amplitude_m.y(), motion.amplitude_m.x());
  const double turned = 0.5 * std::numbers::pi * (1 - std::tanh(kTurnSharpness * std::cos(angle)));
  return {Yaw(forward_yaw + turned), motion.centre_in_world + motion.amplitude_m * std::sin(angle)};
}

RigidTransform At(const WaypointMotion& motion, double time_s) {
  const std::vector<Waypoint>& points = motion.waypoints;
  OFM_CHECK(!points.empty());
  const auto after = std::upper_bound(
      points.begin(), points.end(), time_s,
      [](double time, const Waypoint& waypoint) { return time < waypoint.time_s; });
  if (after == points.begin()) return {Yaw(after->yaw_rad), after->position_in_world};
  const Waypoint& a = *std::prev(after);
  if (after == points.end()) return {Yaw(a.yaw_rad), a.position_in_world};
  const double ratio = (time_s - a.time_s) / (after->time_s - a.time_s);
  return Interpolate({Yaw(a.yaw_rad), a.position_in_world},
                     {Yaw(after->yaw_rad), after->position_in_world}, ratio);
}

RigidTransform At(const ScriptedMotion& motion, double time_s) {
  return motion.world_from_body(time_s);
}

}  // namespace

RigidTransform WorldFromBody(const Motion& motion, double time_s) {
  return std::visit([time_s](const auto& kind) { return At(kind, time_s); }, motion);
}

bool IsMoving(const Motion& motion) { return !std::holds_alternative<StaticMotion>(motion); }

}  // namespace ofm
