// ofm-slam evaluate-map: what of the actors is left in an octree, and what of the room is in it.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "commands.h"
#include "ofm/base/error.h"
#include "ofm/dense/map_metrics.h"
#include "ofm/dense/octree_file.h"
#include "ofm/dense/ply_file.h"
#include "ofm/dense/surface_meter.h"
#include "ofm/eval/ate.h"
#include "ofm/io/atomic_file.h"
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
    "With --static, the same recording without actors, it also needs map.ply, and prints:\n"
    "- the share of the static surface that is mapped. The surface is where all frames without\n"
    "  actors together put it (no depth edges; pixels fused by their precision; three frames at\n"
    "  least). Of the octree's voxels that hold a piece of it (none whose depth noise is over\n"
    "  half a voxel), those count that are occupied in map.ot or touch one that is;\n"
    "- which of these any frame of SEQUENCE shows: no map can have the others;\n"
    "- the median distance of map.ply's points from that surface, point to plane; a point with no\n"
    "  surface within 10 cm counts as 10 cm off.\n"
    "Examples:\n"
    "  ofm-slam evaluate-map out desk_walking\n"
    "  ofm-slam evaluate-map out desk_walking --static tum_fr1_desk --json map.json";

struct MapArguments {
  std::filesystem::path results, sequence, base, json;
  std::optional<double> depth_delay_s;
};

/// What the measuring of a run's map starts from.
struct JudgedMap {
  PinholeCamera camera;
  std::unique_ptr<octomap::ColorOcTree> octree;
  Trajectory truth;
  RigidTransform map_from_truth;
};

/// Frames of `folder` with their true poses, in the map's world.
template <class Visit>
void ForEachFrame(const std::filesystem::path& folder, const JudgedMap& map, Visit&& visit) {
  const RgbdSequence sequence(folder, map.camera);
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    const RgbdFrame frame = sequence.Load(i);
    const auto pose = InterpolatePose(map.truth, frame.depth_stamp_ns);
    if (pose) visit(map.map_from_truth * *pose, frame);
  }
}

cv::Mat LoadMask(const std::filesystem::path& sequence, const RgbdFrame& frame) {
  return LoadMaskImage(sequence / "mask" / (frame.name + ".png"), frame.depth_m.size());
}

JudgedMap LoadMap(const MapArguments& arguments) {
  JudgedMap map;
  map.camera = LoadCamera(arguments.results / "camera.yaml");
  if (arguments.depth_delay_s) map.camera.depth_delay_s = *arguments.depth_delay_s;
  const RgbdSequence sequence(arguments.sequence, map.camera);
  if (!sequence.groundtruth()) throw Error(arguments.sequence, "has no groundtruth.txt");
  map.truth = LoadTrajectory(*sequence.groundtruth());
  const Trajectory estimate = LoadTrajectory(arguments.results / "trajectory.txt");
  map.map_from_truth = AlignPoses(estimate, map.truth).Inverse();
  map.octree = LoadColorOcTree(arguments.results / "map.ot");
  return map;
}

MapMetricsMeter MakeMapMeter(const JudgedMap& map) {
  MapMetricsOptions options;
  options.resolution_m = map.octree->getResolution();
  return {map.camera, options};
}

SurfaceMeter MakeSurfaceMeter(const JudgedMap& map) {
  SurfaceMeterOptions options;
  options.resolution_m = map.octree->getResolution();
  return {map.camera, options};
}

SurfaceMetrics MeasureSurface(SurfaceMeter& meter, const JudgedMap& map,
                              const MapArguments& arguments) {
  const std::vector<LabelledPoint> points = LoadPly(arguments.results / "map.ply");
  ForEachFrame(arguments.base, map,
               [&](const RigidTransform& map_from_camera, const RgbdFrame& frame) {
                 meter.AddFrame(map_from_camera, frame.depth_m);
               });
  return meter.Evaluate(*map.octree, points);
}

void Print(const MapMetrics& metrics) {
  fmt::print("actors   {} of {} voxels that only they filled are occupied ({:.2f} %)\n",
             metrics.actor_only_occupied, metrics.actor_only_voxels,
             100 * metrics.actor_residue_share);
  fmt::print("static   {} of {} voxels are occupied ({:.1f} %; {:.1f} % within one voxel)\n",
             metrics.static_occupied, metrics.static_voxels, 100 * metrics.static_coverage,
             100 * metrics.static_coverage_near);
}

void Print(const SurfaceMetrics& metrics) {
  fmt::print("surface  {} of {} voxels of the room without actors are mapped ({:.1f} %)\n",
             metrics.mapped, metrics.surface_voxels, 100 * metrics.mapped_share);
  fmt::print("seen     {} of these voxels in any frame, {} of them are mapped ({:.1f} %)\n",
             metrics.seen, metrics.seen_mapped,
             metrics.seen == 0 ? 0. : 100. * metrics.seen_mapped / metrics.seen);
  fmt::print("accuracy {:.1f} mm, the median of {} points; {} have no surface within 10 cm\n",
             1e3 * metrics.median_distance_m, metrics.points, metrics.points_off);
}

nlohmann::ordered_json ToJson(const JudgedMap& map, const MapMetrics& metrics) {
  return {{"resolution_m", map.octree->getResolution()},
          {"actor_voxels", metrics.actor_only_voxels},
          {"actor_voxels_occupied", metrics.actor_only_occupied},
          {"actor_residue_share", metrics.actor_residue_share},
          {"static_voxels", metrics.static_voxels},
          {"static_share_occupied", metrics.static_coverage},
          {"static_share_near", metrics.static_coverage_near}};
}

void AddToJson(const SurfaceMetrics& metrics, nlohmann::ordered_json& json) {
  json["surface_voxels"] = metrics.surface_voxels;
  json["surface_share_mapped"] = metrics.mapped_share;
  json["surface_voxels_seen"] = metrics.seen;
  json["surface_voxels_seen_mapped"] = metrics.seen_mapped;
  json["points"] = metrics.points;
  json["points_off_surface"] = metrics.points_off;
  json["median_distance_m"] = metrics.median_distance_m;
}

void EvaluateMap(const MapArguments& arguments) {
  const JudgedMap map = LoadMap(arguments);
  MapMetricsMeter actor_meter = MakeMapMeter(map);
  std::optional<SurfaceMeter> surface_meter;
  if (!arguments.base.empty()) surface_meter = MakeSurfaceMeter(map);
  ForEachFrame(arguments.sequence, map,
               [&](const RigidTransform& map_from_camera, const RgbdFrame& frame) {
                 const cv::Mat mask = LoadMask(arguments.sequence, frame);
                 actor_meter.AddFrame(map_from_camera, frame.depth_m, mask);
                 if (surface_meter) {
                   surface_meter->AddView(map_from_camera, frame.depth_m, mask);
                 }
               });
  const MapMetrics actors = actor_meter.Evaluate(*map.octree);
  nlohmann::ordered_json json = ToJson(map, actors);
  Print(actors);
  if (surface_meter) {
    const SurfaceMetrics surface = MeasureSurface(*surface_meter, map, arguments);
    AddToJson(surface, json);
    Print(surface);
  }
  if (!arguments.json.empty()) WriteFileAtomically(arguments.json, json.dump(2) + "\n");
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
  command->add_option("--static", arguments->base, "The same recording without actors");
  command
      ->add_option(
          "--depth-delay", arguments->depth_delay_s,
          "By which depth images are stamped late against the ground truth [s]; right, the "
          "surface has the fewest voxels. Without it the camera's depth_delay_s")
      ->check(CLI::Range(-1., 1.));
  command->add_option("--json", arguments->json, "Also write all figures to this file");
  command->callback([arguments] { EvaluateMap(*arguments); });
}

}  // namespace ofm
