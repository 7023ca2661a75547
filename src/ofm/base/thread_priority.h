// Threads that give way to others.
#pragma once

namespace ofm {

/// A thread as nice as this takes only what no other thread wants.
inline constexpr int kIdleNiceness = 19;

/// Raises the niceness of the calling thread alone by `niceness` (0 to 19), as far as the system
/// allows; does nothing where threads have no priority of their own (other systems than Linux).
/// With kIdleNiceness the thread also gets the policy SCHED_IDLE: a thread that wakes takes its
/// core at once, while one that is merely nice may first run its slice out (some 3 ms).
void LowerThreadPriority(int niceness);

/// Niceness of the calling thread, -20 (urgent) to 19; 0 on other systems than Linux.
int ThreadNiceness();

}  // namespace ofm
