#include "ofm/eval/evaluation.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "ofm/base/error.h"
#include "ofm/eval/stamps.h"

namespace ofm {
namespace {

using Json = nlohmann::ordered_json;

Coverage ComputeCoverage(const Trajectory& estimate, const Trajectory& groundtruth,
                         std::size_t frames) {
  const Coverage coverage{CountInSpan(StampsOf(estimate), groundtruth), frames};
  if (coverage.poses > frames) {
    throw Error(
        fmt::format("{} estimated poses are more than the {} frames of the recording; "
                    "give the number of frames that have ground truth",
                    coverage.poses, frames));
  }
  return coverage;
}

void AddRow(std::string_view measure, std::string_view what, const ErrorStatistics& s,
            std::string& table) {
  const auto out = std::back_inserter(table);
  fmt::format_to(out, "{:<15}{:<18}{:>9}", measure, what, s.count);
  for (const double value : {s.rmse, s.mean, s.median, s.std, s.min, s.max}) {
    if (s.count > 0) {
      fmt::format_to(out, "{:>11.6f}", value);
    } else {
      fmt::format_to(out, "{:>11}", "-");
    }
  }
  table += '\n';
}

void AddRpe(std::string_view measure, const RpeResult& rpe, std::string& table) {
  AddRow(measure, "translation [m]", rpe.translation_m, table);
  AddRow("", "rotation [deg]", rpe.rotation_deg, table);
}

Json StatisticsToJson(const ErrorStatistics& s) {
  return {{"rmse", s.rmse}, {"mean", s.mean}, {"median", s.median},
          {"std", s.std},   {"min", s.min},   {"max", s.max}};
}

Json RpeToJson(const RpeResult& rpe) {
  if (rpe.translation_m.count == 0) return nullptr;
  return {{"pairs", rpe.translation_m.count},
          {"translation_m", StatisticsToJson(rpe.translation_m)},
          {"rotation_deg", StatisticsToJson(rpe.rotation_deg)}};
}

Json CoverageToJson(const std::optional<Coverage>& coverage) {
  if (!coverage) return nullptr;
  return {{"poses", coverage->poses}, {"frames", coverage->frames}, {"ratio", coverage->ratio()}};
}

}  // namespace

std::size_t CountInSpan(std::span<const std::int64_t> stamps, const Trajectory& groundtruth) {
  if (groundtruth.empty()) return 0;
  const auto inside = [&](std::int64_t stamp_ns) {
    return stamp_ns >= groundtruth.front().stamp_ns && stamp_ns <= groundtruth.back().stamp_ns;
  };
  return static_cast<std::size_t>(std::count_if(stamps.begin(), stamps.end(), inside));
}

TrajectoryEvaluation EvaluateTrajectory(const Trajectory& estimate, const Trajectory& groundtruth,
                                        const EvaluationOptions& options) {
  TrajectoryEvaluation evaluation;
  evaluation.ate =
      ComputeAte(estimate, groundtruth, options.max_difference_s, options.truth_from_estimate);
  const auto rpe = [&](RpePairs pairs) {
    return ComputeRpe(estimate, groundtruth, {.pairs = pairs});
  };
  evaluation.rpe_per_frame = rpe(RpePairs::kConsecutive);
  evaluation.rpe_1s = rpe(RpePairs::kFixedDelta);
  evaluation.rpe_all_pairs = rpe(RpePairs::kAll);
  if (options.frames) {
    evaluation.coverage = ComputeCoverage(estimate, groundtruth, *options.frames);
  }
  return evaluation;
}

std::string FormatEvaluation(const TrajectoryEvaluation& evaluation) {
  std::string table = fmt::format("{:<33}{:>9}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}\n", "", "pairs",
                                  "rmse", "mean", "median", "std", "min", "max");
  AddRow("ATE", "translation [m]", evaluation.ate.translation_m, table);
  AddRpe("RPE per frame", evaluation.rpe_per_frame, table);
  AddRpe("RPE over 1 s", evaluation.rpe_1s, table);
  AddRpe("RPE all pairs", evaluation.rpe_all_pairs, table);
  if (const auto& coverage = evaluation.coverage) {
    table += fmt::format("coverage: {} of {} frames ({:.1f} %)\n", coverage->poses,
                         coverage->frames, 100 * coverage->ratio());
  }
  return table;
}

Json EvaluationToJson(const TrajectoryEvaluation& evaluation) {
  const ErrorStatistics& ate = evaluation.ate.translation_m;
  return {{"ate", {{"pairs", ate.count}, {"translation_m", StatisticsToJson(ate)}}},
          {"rpe_per_frame", RpeToJson(evaluation.rpe_per_frame)},
          {"rpe_1s", RpeToJson(evaluation.rpe_1s)},
          {"rpe_all_pairs", RpeToJson(evaluation.rpe_all_pairs)},
          {"coverage", CoverageToJson(evaluation.coverage)}};
}

}  // namespace ofm
