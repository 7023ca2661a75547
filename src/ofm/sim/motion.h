// How a body of the simulated world moves, as a function of time.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <variant>
#include <vector>

#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// Stays where it is for ever.
struct StaticMotion {
  RigidTransform world_from_body;
};

/// Goes to and fro along a line, like a pendulum: centre + amplitude * sin(2 pi t / period +
/// phase). The body's x axis turns to the way it goes.
struct SweepMotion {
  Eigen::Vector3d centre_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d amplitude_m = Eigen::Vector3d::UnitX();
  double period_s = 5;
  double phase_rad = 0;
};

/// A point on the way of a body.
struct Waypoint {
  double time_s = 0;
  Eigen::Vector3d position_in_world = Eigen::Vector3d::Zero();
  double yaw_rad = 0;  ///< of the body's x axis about the world's z axis
};

/// Straight from way-point to way-point, which are in increasing order of time; at rest before the
/// first and after the last.
struct WaypointMotion {
  std::vector<Waypoint> waypoints;
};

/// Any way to go: a function of time without a state, which threads may call together.
struct ScriptedMotion {
  std::function<RigidTransform(double time_s)> world_from_body;
};

using Motion = std::variant<StaticMotion, SweepMotion, WaypointMotion, ScriptedMotion>;

/// Where a body is at `time_s`.
RigidTransform WorldFromBody(const Motion& motion, double time_s);

/// False for StaticMotion alone.
bool IsMoving(const Motion& motion);

}  // namespace ofm
