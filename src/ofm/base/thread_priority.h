// Threads that give way to others.
#pragma once

namespace ofm {

/// Raises the niceness of the calling thread alone by `niceness` (0 to 19), as far as the system
/// allows; does nothing where threads have no priority of their own (other systems than Linux).
void LowerThreadPriority(int niceness);

/// Niceness of the calling thread, -20 (urgent) to 19; 0 on other systems than Linux.
int ThreadNiceness();

}  // namespace ofm
