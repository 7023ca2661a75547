#include "ofm/base/timing.h"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>

namespace ofm {
namespace {

std::vector<double> OneTo(int n) {
  std::vector<double> values(n);
  std::iota(values.rbegin(), values.rend(), 1.0);  // falling: the order must not matter
  return values;
}

// Returns only when this thread has been on a CPU for so long.
void BurnCpu(double ms) {
  const std::int64_t start_ns = ThreadCpuTimeNs();
  while (static_cast<double>(ThreadCpuTimeNs() - start_ns) < ms * 1e6) {
  }
}

TEST(Summarize, OfNothingIsZero) {
  const DurationStatistics s = Summarize({});
  EXPECT_EQ(s.count, 0u);
  EXPECT_EQ(s.mean_ms, 0);
  EXPECT_EQ(s.median_ms, 0);
  EXPECT_EQ(s.p99_ms, 0);
  EXPECT_EQ(s.max_ms, 0);
}

TEST(Summarize, OfOneDurationIsThatDuration) {
  const DurationStatistics s = Summarize({4.5});
  EXPECT_EQ(s.count, 1u);
  EXPECT_EQ(s.mean_ms, 4.5);
  EXPECT_EQ(s.median_ms, 4.5);
  EXPECT_EQ(s.p99_ms, 4.5);
  EXPECT_EQ(s.max_ms, 4.5);
}

TEST(Summarize, MedianIsTheMiddleOrTheMeanOfTheTwoMiddles) {
  EXPECT_EQ(Summarize({9, 1, 2}).median_ms, 2);
  EXPECT_EQ(Summarize({9, 1, 2, 4}).median_ms, 3);
}

TEST(Summarize, MeanAndMaximumDoNotDependOnTheOrder) {
  const DurationStatistics s = Summarize({3, 8, 1});
  EXPECT_EQ(s.mean_ms, 4);
  EXPECT_EQ(s.max_ms, 8);
}

TEST(Summarize, P99IsTheSmallestThatNinetyNineInAHundredDoNotExceed) {
  EXPECT_EQ(Summarize(OneTo(99)).p99_ms, 99);
  EXPECT_EQ(Summarize(OneTo(100)).p99_ms, 99);
  EXPECT_EQ(Summarize(OneTo(101)).p99_ms, 100);
  EXPECT_EQ(Summarize(OneTo(200)).p99_ms, 198);
  EXPECT_EQ(Summarize(OneTo(1000)).p99_ms, 990);
  EXPECT_EQ(Summarize(OneTo(2)).p99_ms, 2);
}

TEST(Clocks, DoNotGoBack) {
  const std::int64_t steady = SteadyTimeNs(), thread = ThreadCpuTimeNs();
  EXPECT_GE(SteadyTimeNs(), steady);
  EXPECT_GE(ThreadCpuTimeNs(), thread);
}

TEST(Clocks, ThreadTimeLeavesOutOtherThreadsAndProcessTimeDoesNot) {
  const std::int64_t thread_start = ThreadCpuTimeNs(), process_start = ProcessCpuTimeNs();
  std::jthread([] { BurnCpu(30); }).join();
  EXPECT_LT(ThreadCpuTimeNs() - thread_start, 25'000'000);
  EXPECT_GE(ProcessCpuTimeNs() - process_start, 30'000'000);
}

TEST(StageTimes, KeepsWallAndCpuByStage) {
  StageTimes times;
  times.Add("track", 3, 2);
  times.Add("map", 10, 9);
  times.Add("track", 5, 4);
  ASSERT_EQ(times.stages().size(), 2u);
  EXPECT_EQ(times.stages().at("track").wall_ms, (std::vector<double>{3, 5}));
  EXPECT_EQ(times.stages().at("track").cpu_ms, (std::vector<double>{2, 4}));
  EXPECT_EQ(times.stages().at("map").wall_ms, (std::vector<double>{10}));
}

TEST(StageTimes, MergeAppendsTheOthers) {
  StageTimes a, b;
  a.Add("track", 1, 1);
  b.Add("track", 2, 2);
  b.Add("map", 3, 3);
  a.Merge(b);
  EXPECT_EQ(a.stages().at("track").wall_ms, (std::vector<double>{1, 2}));
  EXPECT_EQ(a.stages().at("map").cpu_ms, (std::vector<double>{3}));
  EXPECT_EQ(b.stages().at("track").wall_ms.size(), 1u);
}

TEST(StageTimes, CannotBeMergedWithItself) {
  StageTimes times;
  times.Add("track", 1, 1);
  EXPECT_THROW(times.Merge(times), std::logic_error);
}

TEST(ScopedStageTimer, AddsItsScope) {
  StageTimes times;
  {
    const ScopedStageTimer timer(times, "work");
    BurnCpu(5);
    EXPECT_TRUE(times.stages().empty());
  }
  const StageTimes::Durations& work = times.stages().at("work");
  ASSERT_EQ(work.wall_ms.size(), 1u);
  EXPECT_GE(work.cpu_ms[0], 5);
  EXPECT_GE(work.wall_ms[0], 4.9);
}

TEST(ScopedStageTimer, DoesNotCountSleepAsCpu) {
  StageTimes times;
  {
    const ScopedStageTimer timer(times, "wait");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_GE(times.stages().at("wait").wall_ms[0], 20);
  EXPECT_LT(times.stages().at("wait").cpu_ms[0], 15);
}

}  // namespace
}  // namespace ofm
