// summary.json, as far as a report needs it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ofm {

/// CPU time of a stage [ms].
struct StageSummary {
  std::string name;
  std::size_t count = 0;
  double median_ms = 0, p99_ms = 0, max_ms = 0;
};

struct RunSummary {
  std::string version, input, runner;
  std::string error;  ///< why the run ended early; empty where it did not
  std::uint64_t seed = 0;
  std::size_t frames = 0, frames_tracked = 0, losses = 0, keyframes = 0, landmarks = 0;
  std::size_t loops_closed = 0, submaps_unjoined = 0;
  double mean_masked_share = 0;  ///< 0 to 1
  double wall_s = 0, process_cpu_s = 0, peak_memory_mib = 0;
  std::optional<double> ate_rmse_m, live_ate_rmse_m;  ///< as the run measured them
  std::vector<StageSummary> stages;
};

/// Keys that are missing keep their defaults: older runs wrote fewer. Throws Error with file, and
/// line where it is no JSON, or names the key whose value is of another type.
RunSummary LoadRunSummary(const std::filesystem::path& path);

}  // namespace ofm
