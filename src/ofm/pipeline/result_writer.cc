#include "ofm/pipeline/result_writer.h"

#include <ceres/version.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>

#include "ofm/base/error.h"
#include "ofm/base/time.h"
#include "ofm/dense/octree_file.h"
#include "ofm/dense/pcd_file.h"
#include "ofm/dense/ply_file.h"
#include "ofm/io/atomic_file.h"
#include "ofm/io/trajectory_file.h"
#include "ofm/objects/object_database.h"
#include "ofm/objects/object_json.h"
#include "ofm/pipeline/frame_table.h"

namespace ofm {
namespace {

using Json = nlohmann::ordered_json;

Json StatisticsJson(const DurationStatistics& statistics) {
  return {{"count", statistics.count},
          {"mean_ms", statistics.mean_ms},
          {"median_ms", statistics.median_ms},
          {"p99_ms", statistics.p99_ms},
          {"max_ms", statistics.max_ms}};
}

Json CountsJson(const RunCounts& counts) {
  const double share =
      counts.frames == 0 ? 0 : static_cast<double>(counts.frames_tracked) / counts.frames;
  return {{"frames", counts.frames},
          {"frames_tracked", counts.frames_tracked},
          {"tracked_share", share},
          {"frames_dropped", counts.frames_dropped},
          {"frames_reckoned", counts.frames_reckoned},
          {"losses", counts.losses},
          {"submaps_begun", counts.submaps_begun},
          {"keyframes_made", counts.keyframes_made},
          {"keyframes", counts.keyframes},
          {"landmarks", counts.landmarks},
          {"mean_masked_share", counts.mean_masked_share}};
}

Json PoseJson(const RigidTransform& pose) {
  const Eigen::Vector3d& t = pose.translation();
  const Eigen::Quaterniond& q = pose.rotation();
  return {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
}

Json LoopsJson(const RunOutcome& outcome) {
  const LoopCounts& counts = outcome.loop_counts;
  Json json = {{"closed", counts.closed},
               {"keyframes", counts.keyframes},
               {"similar", counts.similar},
               {"rejected_inconsistent", counts.inconsistent},
               {"rejected_few_matches", counts.few_matches},
               {"rejected_no_alignment", counts.no_alignment},
               {"rejected_few_inliers", counts.few_inliers},
               {"list", Json::array()}};
  for (const LoopRecord& loop : outcome.loops) {
    Json entry = {{"stamp", FormatSeconds(loop.keyframe_stamp_ns)},
                  {"place_stamp", FormatSeconds(loop.place_stamp_ns)},
                  {"place_from_keyframe", PoseJson(loop.place_from_keyframe)},
                  {"matches", loop.matches},
                  {"landmarks_fused", loop.landmarks_fused}};
    if (loop.join) {
      entry["joined_submap"] = loop.join->from.value;
      entry["into_submap"] = loop.join->into.value;
    } else {
      entry["drift_m"] = loop.drift_m;
      entry["drift_deg"] = loop.drift_rad * 180 / M_PI;
    }
    json["list"].push_back(std::move(entry));
  }
  return json;
}

std::string SubmapFileName(SubmapId id) {
  return fmt::format("trajectory_submap_{}.txt", id.value);
}

Json SubmapsJson(const RunOutcome& outcome) {
  Json json = {{"world", outcome.submap.value},
               {"begun", outcome.counts.submaps_begun},
               {"joined", outcome.loop_counts.joined},
               {"unjoined", Json::array()}};
  for (const UnjoinedSubmap& submap : outcome.unjoined) {
    Json entry = {{"id", submap.id.value},
                  {"keyframes", submap.keyframes},
                  {"frames", submap.trajectory.size()}};
    if (!submap.trajectory.empty()) entry["trajectory"] = SubmapFileName(submap.id);
    json["unjoined"].push_back(std::move(entry));
  }
  return json;
}

/// Trajectories of sub-maps that were not joined, and of no earlier run.
void WriteUnjoined(const std::filesystem::path& folder, const RunOutcome& outcome) {
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with("trajectory_submap_")) {
      old.push_back(entry.path());
    }
  }
  for (const std::filesystem::path& file : old) std::filesystem::remove(file);
  for (const UnjoinedSubmap& submap : outcome.unjoined) {
    if (submap.trajectory.empty()) continue;
    SaveTrajectory(folder / SubmapFileName(submap.id), submap.trajectory);
  }
}

Json StagesJson(const StageTimes& times) {
  Json json = Json::object();
  for (const auto& [stage, durations] : times.stages()) {
    json[stage] = {{"cpu", StatisticsJson(Summarize(durations.cpu_ms))},
                   {"wall", StatisticsJson(Summarize(durations.wall_ms))}};
  }
  return json;
}

double PeakMemoryMib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// In the formats wanted; one of an earlier run in another is removed.
void WriteCloud(const std::filesystem::path& folder, const SemanticMap& map,
                const CloudFileOptions& options, const std::vector<std::string>& class_names) {
  const std::filesystem::path ply = folder / "map.ply", pcd = folder / "map.pcd";
  if (options.format == CloudFormat::kPcd) {
    std::filesystem::remove(ply);
  } else {
    WriteFileAtomically(ply, [&](std::ostream& stream) {
      WritePly(stream, map.cloud_in_world, class_names, options.color);
    });
  }
  if (options.format == CloudFormat::kPly) {
    std::filesystem::remove(pcd);
  } else {
    WriteFileAtomically(
        pcd, [&](std::ostream& stream) { WritePcd(stream, map.cloud_in_world, options.color); });
  }
}

void WriteMap(const std::filesystem::path& folder, const SemanticMap& map,
              const DenseOptions& options, const std::vector<std::string>& class_names) {
  WriteCloud(folder, map, options.cloud_file, class_names);
  WriteFileAtomically(folder / "map.ot", [&](std::ostream& stream) {
    WriteColorOcTree(stream, map.octree, options.octree.color);
  });
  WriteFileAtomically(folder / "map.bt",
                      [&](std::ostream& stream) { WriteBinaryOcTree(stream, map.octree); });
  WriteFileAtomically(folder / "map_labels.csv", [&](std::ostream& stream) {
    WriteVoxelLabels(stream, map.octree, class_names);
  });
  if (map.navigation_grid) WriteNavigationGrid(folder, *map.navigation_grid);
}

Json CullingToJson(const CullingCounts& counts) {
  return {{"actor_features", counts.actor_features},
          {"actor_features_kept", counts.actor_features_kept},
          {"actor_features_in_pose", counts.actor_features_in_pose},
          {"static_features", counts.static_features},
          {"static_features_kept", counts.static_features_kept},
          {"actor_share_in_pose", counts.ActorShareInPose()},
          {"static_share_kept", counts.StaticShareKept()}};
}

}  // namespace

void PrepareOutputFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw Error(folder, "cannot be made (" + error.message() + "); choose another --output");
  }
  const std::filesystem::path probe = folder / ".ofm-slam-probe";
  try {
    WriteFileAtomically(probe, "probe");
  } catch (const Error&) {
    throw Error(folder, "cannot be written to; choose another --output");
  }
  std::filesystem::remove(probe, error);
}

std::string SummaryJson(const RunOutcome& outcome, const SlamOptions& options,
                        const RunDescription& description) {
  Json json;
  json["version"] = description.version;
  json["libraries"] = {{"opencv", CV_VERSION}, {"ceres", CERES_VERSION_STRING}};
  json["input"] = description.input;
  json["runner"] = description.runner;
  json["seed"] = options.seed;
  if (!description.loaded_map.empty()) json["loaded_map"] = description.loaded_map;
  if (!description.saved_map.empty()) json["saved_map"] = description.saved_map;
  json["error"] = outcome.error.empty() ? Json(nullptr) : Json(outcome.error);
  json["counts"] = CountsJson(outcome.counts);
  json["loops"] = LoopsJson(outcome);
  json["submaps"] = SubmapsJson(outcome);
  if (description.pose_delays) json["pose_delays"] = StatisticsJson(*description.pose_delays);
  if (description.culling) json["culling"] = CullingToJson(*description.culling);
  if (description.evaluation) json["trajectory"] = EvaluationToJson(*description.evaluation);
  if (description.live_evaluation) {
    json["trajectory_live"] = EvaluationToJson(*description.live_evaluation);
  }
  if (description.evaluation_in_map) {
    json["trajectory_in_map"] = EvaluationToJson(*description.evaluation_in_map);
  }
  if (outcome.semantic_map) {
    json["map"] = {{"cloud_points", outcome.semantic_map->cloud_in_world.size()},
                   {"resolution_m", options.dense.resolution_m},
                   {"floor_found", outcome.semantic_map->navigation_grid.has_value()}};
  }
  if (outcome.objects) {
    json["objects"] = {{"objects", outcome.objects->objects.size()},
                       {"tracks", outcome.objects->tracks.size()}};
  }
  json["wall_s"] = outcome.wall_s;
  json["process_cpu_s"] = outcome.process_cpu_s;
  json["peak_memory_mib"] = PeakMemoryMib();
  json["stages"] = StagesJson(outcome.times);
  return json.dump(2) + "\n";
}

void WriteResults(const std::filesystem::path& folder, const RunOutcome& outcome,
                  const SlamOptions& options, const RunDescription& description) {
  SaveTrajectory(folder / "trajectory.txt", outcome.trajectory);
  SaveTrajectory(folder / "trajectory_live.txt", outcome.live_trajectory);
  SaveTrajectory(folder / "keyframes.txt", outcome.keyframe_trajectory);
  WriteUnjoined(folder, outcome);
  WriteFileAtomically(folder / "frames.csv", FormatFrames(outcome.frames));
  WriteFileAtomically(folder / "times.csv",
                      FormatFrameTimes(TimesOfFrames(outcome.frames, outcome.times)));
  SlamOptions printed = options;
  WriteFileAtomically(folder / "config.yaml", PrintOptionsYaml(OptionFields(printed)));
  PinholeCamera camera = description.camera;
  WriteFileAtomically(folder / "camera.yaml", PrintOptionsYaml(OptionFields(camera)));
  WriteFileAtomically(folder / "summary.json", SummaryJson(outcome, options, description));
  if (outcome.semantic_map) {
    WriteMap(folder, *outcome.semantic_map, options.dense, outcome.class_names);
  }
  if (outcome.objects) {
    SaveObjects(folder / "objects.db", *outcome.objects);
    WriteFileAtomically(folder / "objects.json", ObjectsJson(*outcome.objects));
  }
}

}  // namespace ofm
