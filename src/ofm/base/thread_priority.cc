#include "ofm/base/thread_priority.h"

#ifdef __linux__
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
  constexpr int kMostNice = 19;
  // A failure leaves the thread as urgent as it was, which is no error.
  setpriority(PRIO_PROCESS, ThreadId(), std::min(kMostNice, ThreadNiceness() + niceness));
}

#else

int ThreadNiceness() { return 0; }
void LowerThreadPriority(int niceness) { OFM_CHECK(niceness >= 0); }

#endif

}  // namespace ofm
