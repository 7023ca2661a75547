#include "ofm/loop/loop_correction.h"

#include <cmath>
#include <map>
#include <set>

#include "ofm/loop/essential_graph.h"
#include "ofm/map/covisibility.h"

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

/// The keyframes of a map as a pose graph, and its indices.
class GraphBuilder {
 public:
  explicit GraphBuilder(const MapSnapshot& map) : map_(map) {
    map.keyframes.ForEach([&](const Keyframe& keyframe) {
      index_[keyframe.id] = static_cast<int>(ids_.size());
      problem_.poses.push_back({keyframe.camera_from_world, ids_.empty()});
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

  /// All keyframes' moves; empty where the solver failed.
  std::map<KeyframeId, MapCorrection::KeyframeMove> Solve(const PoseGraphOptions& options) const {
    std::map<KeyframeId, MapCorrection::KeyframeMove> moves;
    const PoseGraphResult result = OptimizePoseGraph(problem_, options);
    if (!result.usable) return moves;
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

/// Landmarks of the place as they will be.
std::vector<Landmark> CorrectedLandmarks(const MapSnapshot& map, const VerifiedLoop& loop,
                                         const MapCorrection& correction, double min_probability) {
  std::vector<Landmark> landmarks;
  for (const LandmarkId id : LandmarksOf(map, KeyframesAbout(map, loop.place), min_probability)) {
    Landmark landmark = *map.landmarks.Find(id);
    auto move = correction.keyframes.find(landmark.first_keyframe);
    if (move == correction.keyframes.end()) {
      move = correction.keyframes.find(landmark.observations.front().keyframe);
    }
    const RigidTransform motion = move->second.after.Inverse() * move->second.before;
    landmark.position_in_world = motion * landmark.position_in_world;
    landmark.mean_view = (motion.rotation().cast<float>() * landmark.mean_view).normalized();
    landmarks.push_back(std::move(landmark));
  }
  return landmarks;
}

/// Landmarks of the place in the keyframes about the one that came back to it.
void FindDuplicates(const MapSnapshot& map, const VerifiedLoop& loop, const MeasurementModel& model,
                    const LoopOptions& options, MapCorrection& correction) {
  constexpr double kRadiusPx = 4;
  constexpr int kMaxHamming = 50;
  std::set<std::pair<LandmarkId, KeyframeId>> known;
  std::set<int> features;
  for (const LoopMatch& match : loop.matches) {
    correction.found.push_back({match.landmark, loop.keyframe, match.feature});
    known.insert({match.landmark, loop.keyframe});
    features.insert(match.feature);
  }
  const std::vector<Landmark> landmarks =
      CorrectedLandmarks(map, loop, correction, options.min_static_probability);
  for (const KeyframeId id : KeyframesAbout(map, loop.keyframe)) {
    const LoopSearch search{correction.keyframes.at(id).after, kRadiusPx, kMaxHamming,
                            options.min_static_probability};
    for (const LoopMatch& match :
         SearchByProjection(model, *map.keyframes.Find(id), landmarks, search)) {
      if (id == loop.keyframe && features.contains(match.feature)) continue;
      if (!known.insert({match.landmark, id}).second) continue;
      correction.found.push_back({match.landmark, id, match.feature});
    }
  }
}

}  // namespace

std::optional<MapCorrection> ComputeLoopCorrection(const MapSnapshot& map, const VerifiedLoop& loop,
                                                   const std::vector<ClosedLoop>& earlier,
                                                   const MeasurementModel& model,
                                                   const LoopOptions& options) {
  GraphBuilder graph(map);
  for (const CovisibilityEdge& edge : EssentialGraph(map, options.strong_covisibility)) {
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
  FindDuplicates(map, loop, model, options, correction);
  return correction;
}

}  // namespace ofm
