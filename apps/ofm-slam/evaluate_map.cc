// ofm-slam evaluate-map: what of the actors is left in an octree, and what of the room is in it.
#include <fmt/format.h>

#include <memory>
#include <string>

#include "commands.h"
#include "ofm/base/error.h"
#include "ofm/dense/map_metrics.h"
#include "ofm/dense/octree_file.h"
#include "ofm/eval/ate.h"
#include "ofm/io/camera_file.h"
#include "ofm/io/image_file.h"
#include "ofm/io/trajectory_file.h"
#include "ofm/io/tum_sequence.h"

namespace ofm {
namespace {

constexpr const char* kFooter =
    "The sequence needs groundtruth.txt and mask/ (PNGs of true instance ids, 0 = static). An "
    "actor\n"
    "voxel is one that only actors' pixels filled; one that the static scene fills too does not\n"
    "count. A static voxel is one that static pixels of three frames filled.\n"
    "Example:\n"
    "  ofm-slam evaluate-map out desk_walking";

struct MapArguments {
  std::filesystem::path results, sequence;
};

cv::Mat LoadMask(const std::filesystem::path& sequence, const RgbdFrame& frame) {
  return LoadMaskImage(sequence / "mask" / (frame.name + ".png"), frame.depth_m.size());
}

MapMetrics Measure(const MapArguments& arguments) {
  const PinholeCamera camera = LoadCamera(arguments.results / "camera.yaml");
  const RgbdSequence sequence(arguments.sequence, camera);
  if (!sequence.groundtruth()) throw Error(arguments.sequence, "has no groundtruth.txt");
  const Trajectory truth = LoadTrajectory(*sequence.groundtruth());
  const Trajectory estimate = LoadTrajectory(arguments.results / "trajectory.txt");
  const RigidTransform map_from_truth = AlignPoses(estimate, truth).Inverse();
  const auto octree = LoadColorOcTree(arguments.results / "map.ot");
  MapMetricsOptions options;
  options.resolution_m = octree->getResolution();
  MapMetricsMeter meter(camera, options);
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    const RgbdFrame frame = sequence.Load(i);
    const auto pose = InterpolatePose(truth, frame.stamp_ns);
    if (!pose) continue;
    meter.AddFrame(map_from_truth * *pose, frame.depth_m, LoadMask(arguments.sequence, frame));
  }
  return meter.Evaluate(*octree);
}

void EvaluateMap(const MapArguments& arguments) {
  const MapMetrics metrics = Measure(arguments);
  fmt::print("actors   {} of {} voxels that only they filled are occupied ({:.2f} %)\n",
             metrics.actor_only_occupied, metrics.actor_only_voxels,
             100 * metrics.actor_residue_share);
  fmt::print("static   {} of {} voxels are occupied ({:.1f} %; {:.1f} % within one voxel)\n",
             metrics.static_occupied, metrics.static_voxels, 100 * metrics.static_coverage,
             100 * metrics.static_coverage_near);
}

}  // namespace

void AddEvaluateMapCommand(CLI::App& app) {
  auto arguments = std::make_shared<MapArguments>();
  CLI::App* command =
      app.add_subcommand("evaluate-map", "Print what of the actors is left in an octree");
  command->footer(kFooter);
  command->add_option("RESULTS", arguments->results, "Output folder of ofm-slam run")->required();
  command->add_option("SEQUENCE", arguments->sequence, "The TUM RGB-D folder that it ran on")
      ->required();
  command->callback([arguments] { EvaluateMap(*arguments); });
}

}  // namespace ofm
