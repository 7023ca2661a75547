// The files that a run leaves.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "ofm/eval/evaluation.h"
#include "ofm/pipeline/culling_meter.h"
#include "ofm/pipeline/options.h"
#include "ofm/pipeline/run_outcome.h"

namespace ofm {

/// Makes the folder and tries to write in it; throws Error that says what to do where that fails.
void PrepareOutputFolder(const std::filesystem::path& folder);

/// What the files tell beside the outcome.
struct RunDescription {
  std::string version;                          ///< of the program
  std::string input;                            ///< sequence folder
  std::string runner;                           ///< "sequential" or "threaded"
  std::string loaded_map = {}, saved_map = {};  ///< files; empty where there are none
  PinholeCamera camera;
  std::optional<TrajectoryEvaluation> evaluation, live_evaluation;  ///< where there is ground truth
  /// The trajectory in the loaded map's world, aligned by the map's own keyframes.
  std::optional<TrajectoryEvaluation> evaluation_in_map;
  std::optional<CullingCounts> culling;           ///< where there are true masks
  std::optional<DurationStatistics> pose_delays;  ///< of DelayMeter, at the camera's pace
};

/// Writes trajectory.txt, trajectory_live.txt, keyframes.txt, frames.csv, times.csv, map.ply or
/// map.pcd or both (dense.cloud_file.format), map.ot, map.bt, map_labels.csv, map.pgm and map.yaml
/// (where a floor was found), objects.db, objects.json, camera.yaml, config.yaml and summary.json,
/// each one atomically, and trajectory_submap_N.txt for frames whose place in their world was never
/// found; such files of an earlier run are removed. Throws Error where one cannot be written; those
/// before it are then there.
void WriteResults(const std::filesystem::path& folder, const RunOutcome& outcome,
                  const SlamOptions& options, const RunDescription& description);

/// summary.json's text: counts, coverage, errors, time per stage, versions, seed.
std::string SummaryJson(const RunOutcome& outcome, const SlamOptions& options,
                        const RunDescription& description);

}  // namespace ofm
