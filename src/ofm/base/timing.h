// Clocks and the statistics of repeated durations.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace ofm {

/// Nanoseconds that this thread has spent on a CPU.
std::int64_t ThreadCpuTimeNs();
/// Nanoseconds that all threads of this process have spent on CPUs.
std::int64_t ProcessCpuTimeNs();
/// Nanoseconds of a clock that never goes back.
std::int64_t SteadyTimeNs();

/// Statistics of a list of durations [ms].
struct DurationStatistics {
  std::size_t count = 0;
  double mean_ms = 0, median_ms = 0, p99_ms = 0, max_ms = 0;
};

/// p99 is the smallest duration that at least 99 % do not exceed. All zero for an empty list.
DurationStatistics Summarize(std::vector<double> durations_ms);

/// Wall and CPU durations by stage name. Not thread-safe: one per thread, merged at the end.
class StageTimes {
 public:
  struct Durations {
    std::vector<double> wall_ms, cpu_ms;
  };

  void Add(const std::string& stage, double wall_ms, double cpu_ms);
  /// Appends the durations of `other`, another object.
  void Merge(const StageTimes& other);
  const std::map<std::string, Durations>& stages() const { return stages_; }

 private:
  std::map<std::string, Durations> stages_;
};

/// Adds the time from construction to destruction to `times`, which must outlive it.
class ScopedStageTimer {
 public:
  ScopedStageTimer(StageTimes& times, std::string stage);
  ~ScopedStageTimer();
  ScopedStageTimer(const ScopedStageTimer&) = delete;
  ScopedStageTimer& operator=(const ScopedStageTimer&) = delete;

 private:
  StageTimes& times_;
  std::string stage_;
  std::int64_t wall_start_ns_, cpu_start_ns_;
};

}  // namespace ofm
