// ofm-slam evaluate: errors of a trajectory against ground truth.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "ofm/base/error.h"
#include "ofm/eval/evaluation.h"
#include "ofm/io/atomic_file.h"
#include "ofm/io/trajectory_file.h"
#include "ofm/io/tum_index.h"
#include "ofm/map/map_file.h"
#include "ofm/map/submap.h"
#include "ofm/pipeline/trajectory_log.h"

namespace ofm {
namespace {

constexpr const char* kFooter =
    "ATE: after the best rigid alignment, without scale. RPE: errors of the motion from each pose\n"
    "to the next, to the one 1 s later, and between all poses. Figures of different intervals\n"
    "cannot be compared. Both files hold lines 'timestamp tx ty tz qx qy qz qw' [s, m].\n"
    "--align-with measures a trajectory in the world of a map: the ATE is then after the "
    "alignment\n"
    "of the map's own keyframes, or of any trajectory in that world, with its ground truth.\n"
    "Examples:\n"
    "  ofm-slam evaluate out/trajectory.txt desk/groundtruth.txt\n"
    "  ofm-slam evaluate out/trajectory.txt desk/groundtruth.txt --sequence desk --json "
    "errors.json\n"
    "  ofm-slam evaluate out/trajectory.txt desk/groundtruth.txt --align-with desk.ofm";

struct EvaluateArguments {
  std::string estimate, groundtruth, sequence, json, align_with, align_truth;
  std::optional<std::size_t> frames;
  double max_difference_s = kMaxStampDifference_s;
};

/// Number of frames of a recording that have ground truth.
std::size_t CountFrames(const std::string& sequence, const Trajectory& groundtruth) {
  std::vector<std::int64_t> stamps;
  for (const TumEntry& entry : ReadTumIndex(sequence).entries) {
    stamps.push_back(entry.color.stamp_ns);
  }
  const std::size_t frames = CountInSpan(stamps, groundtruth);
  if (frames == 0) throw Error(sequence, "has no frame within the time of the ground truth");
  return frames;
}

/// A trajectory file, or the keyframes of a map file.
Trajectory LoadTrajectoryOrMap(const std::string& path) {
  if (std::filesystem::path(path).extension() == ".ofm") {
    const StoredMap stored = LoadMap(path);
    return KeyframeTrajectory(*stored.map, LargestSubmap(*stored.map));
  }
  return LoadTrajectory(path);
}

/// Best fit of another trajectory of the estimate's world.
RigidTransform FindAlignment(const EvaluateArguments& arguments, const Trajectory& groundtruth) {
  const Trajectory truth =
      arguments.align_truth.empty() ? groundtruth : LoadTrajectory(arguments.align_truth);
  try {
    return ComputeAte(LoadTrajectoryOrMap(arguments.align_with), truth, arguments.max_difference_s)
        .truth_from_estimate;
  } catch (const Error& error) {
    throw Error(fmt::format("--align-with {}: {}", arguments.align_with, error.what()));
  }
}

void Evaluate(const EvaluateArguments& arguments) {
  const Trajectory estimate = LoadTrajectory(arguments.estimate);
  const Trajectory groundtruth = LoadTrajectory(arguments.groundtruth);
  if (estimate.empty()) throw Error(arguments.estimate, "holds no pose");
  if (groundtruth.size() < 2) throw Error(arguments.groundtruth, "holds fewer than 2 poses");
  EvaluationOptions options;
  options.max_difference_s = arguments.max_difference_s;
  options.frames = arguments.frames;
  if (!arguments.align_with.empty()) {
    options.truth_from_estimate = FindAlignment(arguments, groundtruth);
  }
  if (!arguments.sequence.empty()) options.frames = CountFrames(arguments.sequence, groundtruth);

  const TrajectoryEvaluation evaluation = EvaluateTrajectory(estimate, groundtruth, options);
  fmt::print("{}", FormatEvaluation(evaluation));
  if (arguments.json.empty()) return;
  nlohmann::ordered_json json = {{"estimate", arguments.estimate},
                                 {"groundtruth", arguments.groundtruth}};
  json.update(EvaluationToJson(evaluation));
  WriteFileAtomically(arguments.json, json.dump(2) + "\n");
}

}  // namespace

void AddEvaluateCommand(CLI::App& app) {
  auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = app.add_subcommand("evaluate", "Print a trajectory's errors (ATE and RPE)");
  command->footer(kFooter);
  command->add_option("ESTIMATE", arguments->estimate, "Estimated trajectory, TUM format")
      ->required();
  command->add_option("GROUNDTRUTH", arguments->groundtruth, "True trajectory, TUM format")
      ->required();
  command
      ->add_option("--max-difference", arguments->max_difference_s,
                   "Largest difference [s] between the times of a pose and its truth")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI::Option* align_with =
      command->add_option("--align-with", arguments->align_with,
                          "Map (.ofm) or other trajectory of the estimate's world that gives the "
                          "ATE's alignment");
  command
      ->add_option("--align-truth", arguments->align_truth,
                   "True trajectory of --align-with, where it is another one than GROUNDTRUTH")
      ->needs(align_with);
  CLI::Option* frames =
      command
          ->add_option("--frames", arguments->frames,
                       "Number of frames within the ground truth's time: prints the coverage")
          ->check(CLI::PositiveNumber);
  command
      ->add_option("--sequence", arguments->sequence,
                   "TUM RGB-D folder whose frames are counted for the coverage")
      ->excludes(frames);
  command->add_option("--json", arguments->json, "Also write all figures to this file");
  command->callback([arguments] { Evaluate(*arguments); });
}

}  // namespace ofm
