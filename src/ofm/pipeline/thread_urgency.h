// Who gives way when a run has more threads than cores.
#pragma once

namespace ofm {

/// The front end and tracking have the camera's pace to keep, so they come first: what tracking
/// does not wait for takes the time that they leave. Given to LowerThreadPriority.
inline constexpr int kMappingNiceness = 2;  ///< key frames wait for it
inline constexpr int kUpkeepNiceness = 10;  ///< nothing waits for it until the run's end
// The network's thread is less urgent still: perception.schedule.niceness.

}  // namespace ofm
