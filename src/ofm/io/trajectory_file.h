// Trajectories in the TUM RGB-D benchmark's text format.
#pragma once

#include <filesystem>
#include <string>

#include "ofm/geometry/trajectory.h"

namespace ofm {

/// Reads lines "timestamp tx ty tz qx qy qz qw" [s, m, unit quaternion of world_from_camera];
/// '#' starts a comment. Quaternions are normalised. Throws Error with path and line for a wrong
/// number of fields, a value that is no finite number, a zero quaternion, and times that do not
/// increase. An empty trajectory is valid: nothing was tracked.
Trajectory LoadTrajectory(const std::filesystem::path& path);

/// What SaveTrajectory writes: a comment that states the convention, then one line per pose, with 6
/// decimals of the time and 9 of the values.
std::string FormatTrajectory(const Trajectory& trajectory);

/// Writes atomically (see atomic_file.h).
void SaveTrajectory(const std::filesystem::path& path, const Trajectory& trajectory);

}  // namespace ofm
