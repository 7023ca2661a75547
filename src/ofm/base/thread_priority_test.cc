#include "ofm/base/thread_priority.h"

#include <gtest/gtest.h>

#ifdef __linux__
#include <sched.h>
#endif

#include <algorithm>
#include <stdexcept>
#include <thread>

namespace ofm {
namespace {

TEST(ThreadPriority, LowersTheCallingThreadAlone) {
#ifndef __linux__
  GTEST_SKIP() << "threads have no niceness of their own here";
#endif
  const int before = ThreadNiceness();
  int inside = -100;
  std::jthread([&] {
    LowerThreadPriority(3);
    inside = ThreadNiceness();
  }).join();
  EXPECT_EQ(inside, std::min(19, before + 3));
  EXPECT_EQ(ThreadNiceness(), before);
}

TEST(ThreadPriority, StopsAtTheLowest) {
  std::jthread([] {
    LowerThreadPriority(100);
    EXPECT_LE(ThreadNiceness(), 19);
    LowerThreadPriority(0);
  }).join();
}

TEST(ThreadPriority, TheNicestThreadAloneIsIdle) {
#ifndef __linux__
  GTEST_SKIP() << "threads have no policy of their own here";
#else
  const int own = sched_getscheduler(0);
  int nice = -1, idle = -1;
  std::jthread([&] {
    LowerThreadPriority(kIdleNiceness - 1 - ThreadNiceness());
    nice = sched_getscheduler(0);
    LowerThreadPriority(1);
    idle = sched_getscheduler(0);
  }).join();
  EXPECT_EQ(nice, own);
  EXPECT_EQ(idle, SCHED_IDLE);
  EXPECT_EQ(sched_getscheduler(0), own);
#endif
}

TEST(ThreadPriority, RaisingIsAProgrammersError) {
  EXPECT_THROW(LowerThreadPriority(-1), std::logic_error);
}

}  // namespace
}  // namespace ofm
