#include "ofm/base/mutex.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace ofm {
namespace {

TEST(MutexLock, LetsOneThreadInAtATime) {
  constexpr int kThreads = 4, kRounds = 2000;
  Mutex mutex;
  int count = 0;
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < kThreads; ++t) {
      threads.emplace_back([&] {
        for (int i = 0; i < kRounds; ++i) {
          const MutexLock lock(mutex);
          ++count;
        }
      });
    }
  }
  EXPECT_EQ(count, kThreads * kRounds);
}

TEST(MutexLock, ReleasesAtTheEndOfItsScope) {
  Mutex mutex;
  for (int i = 0; i < 2; ++i) {
    const MutexLock lock(mutex);  // would wait for ever if the first round kept it
  }
  std::unique_lock<Mutex> other(mutex);
  EXPECT_TRUE(other.owns_lock());
}

}  // namespace
}  // namespace ofm
