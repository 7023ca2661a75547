#include "ofm/base/thread_priority.h"

#ifdef __linux__
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#include <algorithm>

#include "ofm/base/check.h"

namespace ofm {

#ifdef __linux__

namespace {

// On Linux a thread's id names the thread alone, whatever POSIX says of processes.
id_t ThreadId() { return static_cast<id_t>(syscall(SYS_gettid)); }

}  // namespace

int ThreadNiceness() { return getpriority(PRIO_PROCESS, ThreadId()); }

void LowerThreadPriority(int niceness) {
  OFM_CHECK(niceness >= 0);
  const int lowered = std::min(kIdleNiceness, ThreadNiceness() + niceness);
  // A failure leaves the thread as urgent as it was, which is no error.
  setpriority(PRIO_PROCESS, ThreadId(), lowered);
  if (lowered < kIdleNiceness) return;
  constexpr sched_param kNoPriority{};
  sched_setscheduler(static_cast<pid_t>(ThreadId()), SCHED_IDLE, &kNoPriority);
}

#else

int ThreadNiceness() { return 0; }
void LowerThreadPriority(int niceness) { OFM_CHECK(niceness >= 0); }

#endif

}  // namespace ofm
