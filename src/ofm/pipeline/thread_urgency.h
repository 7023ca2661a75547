// Who gives way when a run has more threads than cores.
#pragma once

#include "ofm/base/thread_priority.h"

namespace ofm {

/// The front end and tracking have the camera's pace to keep, so they come first: what tracking
/// does not wait for takes the time that they leave. Given to LowerThreadPriority.
inline constexpr int kMappingNiceness = 1;      ///< key frames wait for it
inline constexpr int kAdjustmentNiceness = 10;  ///< of the whole map; mapping waits for its end
inline constexpr int kDenseNiceness = kIdleNiceness;  ///< of the dense maps
// The network's thread is as idle: perception.schedule.niceness.

}  // namespace ofm
