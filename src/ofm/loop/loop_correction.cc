#include "ofm/loop/loop_correction.h"

#include <cmath>
#include <map>

#include "ofm/loop/essential_graph.h"
#include "ofm/loop/loop_duplicates.h"
#include "ofm/map/submap.h"

namespace ofm {
namespace {

/// Of an edge between keyframes that share `kUsualShared` landmarks; information grows with these.
constexpr RelativePoseSigma kSigma{0.01, 0.01};
constexpr double kUsualShared = 100;
/// A loop is measured by its landmarks; the way round it has drifted.
constexpr double kLoopSigmaScale = 0.1;

RelativePoseSigma Scaled(double scale) {
  return {scale * kSigma.translation_m, scale * kSigma.rotation_rad};
}

/// The keyframes of a sub-map as a pose graph, and its indices.
class GraphBuilder {
 public:
  GraphBuilder(const MapSnapshot& map, SubmapId submap) : map_(map) {
    const KeyframeId held = FindWorldHolder(map, submap);
    map.keyframes.ForEach([&](const Keyframe& keyframe) {
      if (keyframe.submap != submap) return;
      index_[keyframe.id] = static_cast<int>(ids_.size());
      problem_.poses.push_back({keyframe.camera_from_world, keyframe.id == held});
      ids_.push_back(keyframe.id);
    });
  }

  /// An edge as the map has it now.
  void AddEdge(KeyframeId source, KeyframeId target, double sigma_scale) {
    AddMeasured(source, target, Pose(target) * Pose(source).Inverse(), sigma_scale);
  }
  void AddMeasured(KeyframeId source, KeyframeId target, const RigidTransform& target_from_source,
                   double sigma_scale) {
    problem_.edges.push_back(
        {index_.at(source), index_.at(target), target_from_source, Scaled(sigma_scale)});
  }
  /// Where the optimisation starts.
  void SetStart(KeyframeId id, const RigidTransform& camera_from_world) {
    auto& pose = problem_.poses[index_.at(id)];
    if (!pose.fixed) pose.camera_from_world = camera_from_world;
  }
  bool Has(KeyframeId id) const { return index_.contains(id); }
  const RigidTransform& Pose(KeyframeId id) const {
    return map_.keyframes.Find(id)->camera_from_world;
  }

  /// The moves of all keyframes of the map; empty where the solver failed.
  std::map<KeyframeId, MapCorrection::KeyframeMove> Solve(const PoseGraphOptions& options) const {
    std::map<KeyframeId, MapCorrection::KeyframeMove> moves;
    const PoseGraphResult result = OptimizePoseGraph(problem_, options);
    if (!result.usable) return moves;
    map_.keyframes.ForEach([&](const Keyframe& keyframe) {
      moves[keyframe.id] = {keyframe.camera_from_world, keyframe.camera_from_world};
    });
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      moves[ids_[i]] = {Pose(ids_[i]), result.camera_from_world[i]};
    }
    return moves;
  }

 private:
  const MapSnapshot& map_;
  std::vector<KeyframeId> ids_;
  std::map<KeyframeId, int> index_;
  PoseGraphProblem problem_;
};

}  // namespace

std::optional<MapCorrection> ComputeLoopCorrection(const MapSnapshot& map, const VerifiedLoop& loop,
                                                   const std::vector<ClosedLoop>& earlier,
                                                   const MeasurementModel& model,
                                                   const LoopOptions& options) {
  const SubmapId submap = map.FindSubmap(loop.keyframe);
  GraphBuilder graph(map, submap);
  for (const CovisibilityEdge& edge : EssentialGraph(map, submap, options.strong_covisibility)) {
    graph.AddEdge(edge.a, edge.b, std::sqrt(kUsualShared / std::max(edge.shared_landmarks, 1)));
  }
  for (const ClosedLoop& closed : earlier) {
    if (graph.Has(closed.keyframe) && graph.Has(closed.place)) {
      graph.AddEdge(closed.place, closed.keyframe, kLoopSigmaScale);
    }
  }
  graph.AddMeasured(loop.keyframe, loop.place, loop.place_from_keyframe, kLoopSigmaScale);
  // The keyframes about the one that came back move with it at once; the optimiser spreads the
  // rest.
  const RigidTransform drifted_from_world = graph.Pose(loop.keyframe);
  for (const KeyframeId id : KeyframesAbout(map, loop.keyframe)) {
    graph.SetStart(id, graph.Pose(id) * drifted_from_world.Inverse() * loop.camera_from_world);
  }
  MapCorrection correction;
  correction.keyframes = graph.Solve(options.pose_graph);
  if (correction.keyframes.empty()) return {};
  AddDuplicates(map, loop, model, options, correction);
  return correction;
}

}  // namespace ofm
