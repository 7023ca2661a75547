// The files that a run leaves.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "ofm/eval/trajectory_errors.h"
#include "ofm/pipeline/options.h"
#include "ofm/pipeline/run_outcome.h"

namespace ofm {

/// Makes the folder and tries to write in it; throws Error that says what to do where that fails.
void PrepareOutputFolder(const std::filesystem::path& folder);

/// What summary.json tells beside the outcome.
struct RunDescription {
  std::string input;  ///< sequence folder
  PinholeCamera camera;
  std::string runner;                                   ///< "sequential" or "threaded"
  std::optional<TrajectoryErrors> errors, live_errors;  ///< where ground truth was there
};

/// Writes trajectory.txt, trajectory_live.txt, keyframes.txt, map.ply, map.ot, map.bt, config.yaml
/// and summary.json, each one atomically. Throws Error where one cannot be written; the others are
/// there.
void WriteResults(const std::filesystem::path& folder, const RunOutcome& outcome,
                  const SlamOptions& options, const RunDescription& description);

/// summary.json's text.
std::string SummaryJson(const RunOutcome& outcome, const SlamOptions& options,
                        const RunDescription& description);

}  // namespace ofm
