#include "ofm/base/timing.h"

#include <time.h>  // NOLINT(modernize-deprecated-headers): clock_gettime is POSIX, not C++

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ofm/base/check.h"

namespace ofm {
namespace {

std::int64_t ReadClockNs(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

}  // namespace

std::int64_t ThreadCpuTimeNs() { return ReadClockNs(CLOCK_THREAD_CPUTIME_ID); }
std::int64_t ProcessCpuTimeNs() { return ReadClockNs(CLOCK_PROCESS_CPUTIME_ID); }
std::int64_t SteadyTimeNs() { return ReadClockNs(CLOCK_MONOTONIC); }

DurationStatistics Summarize(std::vector<double> durations_ms) {
  DurationStatistics result;
  result.count = durations_ms.size();
  if (durations_ms.empty()) return result;
  std::sort(durations_ms.begin(), durations_ms.end());
  const std::size_t n = durations_ms.size();
  result.mean_ms = std::accumulate(durations_ms.begin(), durations_ms.end(), 0.0) / n;
  result.median_ms =
      n % 2 ? durations_ms[n / 2] : (durations_ms[n / 2 - 1] + durations_ms[n / 2]) / 2;
  result.p99_ms = durations_ms[static_cast<std::size_t>(std::ceil(0.99 * n)) - 1];
  result.max_ms = durations_ms.back();
  return result;
}

void StageTimes::Add(const std::string& stage, double wall_ms, double cpu_ms) {
  Durations& durations = stages_[stage];
  durations.wall_ms.push_back(wall_ms);
  durations.cpu_ms.push_back(cpu_ms);
}

void StageTimes::Merge(const StageTimes& other) {
  OFM_CHECK(&other != this);
  for (const auto& [stage, durations] : other.stages_) {
    Durations& mine = stages_[stage];
    mine.wall_ms.insert(mine.wall_ms.end(), durations.wall_ms.begin(), durations.wall_ms.end());
    mine.cpu_ms.insert(mine.cpu_ms.end(), durations.cpu_ms.begin(), durations.cpu_ms.end());
  }
}

ScopedStageTimer::ScopedStageTimer(StageTimes& times, std::string stage)
    : times_(times),
      stage_(std::move(stage)),
      wall_start_ns_(SteadyTimeNs()),
      cpu_start_ns_(ThreadCpuTimeNs()) {}

ScopedStageTimer::~ScopedStageTimer() {
  times_.Add(stage_, (SteadyTimeNs() - wall_start_ns_) * 1e-6,
             (ThreadCpuTimeNs() - cpu_start_ns_) * 1e-6);
}

}  // namespace ofm
