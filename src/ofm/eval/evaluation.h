// All figures of one trajectory, and how they are shown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>

#include "ofm/eval/ate.h"
#include "ofm/eval/rpe.h"
#include "ofm/geometry/trajectory.h"

namespace ofm {

/// How many of the frames that have ground truth got a pose. An error means little without it.
struct Coverage {
  std::size_t poses = 0;   ///< estimated, within the ground truth's span of time
  std::size_t frames = 0;  ///< of the recording, within the same span

  double ratio() const {
    return frames == 0 ? 0 : static_cast<double>(poses) / static_cast<double>(frames);
  }
};

/// Number of `stamps` [ns] from the first to the last pose of `groundtruth`.
std::size_t CountInSpan(std::span<const std::int64_t> stamps, const Trajectory& groundtruth);

struct EvaluationOptions {
  double max_difference_s = kMaxStampDifference_s;  ///< between a pose and its truth, for the ATE
  std::optional<std::size_t> frames;  ///< within the ground truth's span; gives the coverage
  /// Where it is known, as of a map that both worlds share; else the ATE's is the best one.
  std::optional<RigidTransform> truth_from_estimate = {};
};

struct TrajectoryEvaluation {
  AteResult ate;
  RpeResult rpe_per_frame, rpe_1s, rpe_all_pairs;
  std::optional<Coverage> coverage;
};

/// Throws Error as ComputeAte does, and where there are more poses than frames.
TrajectoryEvaluation EvaluateTrajectory(const Trajectory& estimate, const Trajectory& groundtruth,
                                        const EvaluationOptions& options = {});

/// A table for people, with units; ends in a newline.
std::string FormatEvaluation(const TrajectoryEvaluation& evaluation);

/// {"ate": {"pairs", "translation_m": {"rmse", ...}}, "rpe_per_frame": {"pairs", "translation_m",
/// "rotation_deg"}, "rpe_1s", "rpe_all_pairs", "coverage": {"poses", "frames", "ratio"}}. An RPE
/// without a pair is null, as is an unknown coverage.
nlohmann::ordered_json EvaluationToJson(const TrajectoryEvaluation& evaluation);

}  // namespace ofm
