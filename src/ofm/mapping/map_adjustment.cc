#include "ofm/mapping/map_adjustment.h"

#include <algorithm>
#include <map>
#include <set>

#include "ofm/map/covisibility.h"
#include "ofm/map/submap.h"

namespace ofm {
namespace {

/// A copy of a part of the map, and how its indices map back to ids.
struct MapExtract {
  BundleProblem problem;
  std::vector<KeyframeId> keyframes;           // by pose index
  std::vector<LandmarkId> landmarks;           // by point index
  std::vector<LandmarkSighting> observations;  // by observation index
};

struct AdjustmentScope {
  std::set<KeyframeId> free, fixed;
  std::set<LandmarkId> landmarks;
};

/// `Keyframes` and `Landmarks` are the tables of a map or of a snapshot.
template <class Keyframes, class Landmarks>
MapExtract Extract(const Keyframes& keyframes, const Landmarks& landmarks,
                   const AdjustmentScope& scope, const MeasurementModel& model) {
  MapExtract extract;
  std::map<KeyframeId, int> pose_index;
  const auto add_pose = [&](KeyframeId id, bool fixed) {
    pose_index[id] = static_cast<int>(extract.keyframes.size());
    extract.keyframes.push_back(id);
    extract.problem.poses.push_back({keyframes.Find(id)->camera_from_world, fixed});
  };
  for (const KeyframeId id : scope.free) add_pose(id, false);
  for (const KeyframeId id : scope.fixed) add_pose(id, true);
  for (const LandmarkId id : scope.landmarks) {
    const Landmark& landmark = *landmarks.Find(id);
    const int point = static_cast<int>(extract.landmarks.size());
    extract.landmarks.push_back(id);
    extract.problem.points_in_world.push_back(landmark.position_in_world);
    for (const Landmark::Observation& o : landmark.observations) {
      const auto pose = pose_index.find(o.keyframe);
      if (pose == pose_index.end()) continue;
      const Keyframe& keyframe = *keyframes.Find(o.keyframe);
      PointObservation seen = model.Observe(*keyframe.features, o.feature);
      seen.weight *= landmark.static_probability;
      extract.problem.observations.push_back({pose->second, point, seen});
      extract.observations.push_back({id, o.keyframe, o.feature});
    }
  }
  return extract;
}

/// Writes the result back; observations found wrong leave the map.
void Apply(const MapExtract& extract, const BundleResult& result, Map& map) {
  for (std::size_t i = 0; i < extract.keyframes.size(); ++i) {
    if (!extract.problem.poses[i].fixed) {
      map.SetKeyframePose(extract.keyframes[i], result.camera_from_world[i]);
    }
  }
  for (std::size_t i = 0; i < extract.landmarks.size(); ++i) {
    map.SetLandmarkPosition(extract.landmarks[i], result.points_in_world[i]);
  }
  for (std::size_t i = 0; i < extract.observations.size(); ++i) {
    const LandmarkSighting& sighting = extract.observations[i];
    if (!result.inlier[i]) map.RemoveObservation(sighting.landmark, sighting.keyframe);
  }
  for (const LandmarkId id : extract.landmarks) {
    if (map.landmarks().Find(id) != nullptr) map.RefreshLandmark(id);
  }
}

MapCorrection MakeCorrection(const MapExtract& extract, const BundleResult& result) {
  MapCorrection correction;
  for (std::size_t i = 0; i < extract.keyframes.size(); ++i) {
    correction.keyframes[extract.keyframes[i]] = {extract.problem.poses[i].camera_from_world,
                                                  result.camera_from_world[i]};
  }
  for (std::size_t i = 0; i < extract.landmarks.size(); ++i) {
    correction.landmarks[extract.landmarks[i]] = {extract.problem.points_in_world[i],
                                                  result.points_in_world[i]};
  }
  for (std::size_t i = 0; i < extract.observations.size(); ++i) {
    if (!result.inlier[i]) correction.wrong.push_back(extract.observations[i]);
  }
  return correction;
}

void Solve(const AdjustmentScope& scope, const BundleOptions& bundle, const MeasurementModel& model,
           std::stop_token stop, Map& map) {
  const MapExtract extract = Extract(map.keyframes(), map.landmarks(), scope, model);
  const BundleResult result = AdjustBundle(model.camera, extract.problem, bundle, stop);
  if (result.usable) Apply(extract, result, map);
}

/// Other keyframes that see the scope's landmarks, those that see most first.
std::set<KeyframeId> FindFixed(const Map& map, const AdjustmentScope& scope, int limit) {
  std::map<KeyframeId, int> counts;
  for (const LandmarkId id : scope.landmarks) {
    for (const Landmark::Observation& o : map.GetLandmark(id).observations) {
      if (!scope.free.contains(o.keyframe)) ++counts[o.keyframe];
    }
  }
  std::vector<std::pair<KeyframeId, int>> order(counts.begin(), counts.end());
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  if (static_cast<int>(order.size()) > limit) order.resize(limit);
  std::set<KeyframeId> fixed;
  for (const auto& [id, count] : order) fixed.insert(id);
  return fixed;
}

}  // namespace

void AdjustLocally(Map& map, KeyframeId current, const MeasurementModel& model,
                   const MappingOptions& options, std::stop_token stop) {
  AdjustmentScope scope;
  scope.free.insert(current);
  for (const CovisibleKeyframe& neighbour : FindCovisible(map, current)) {
    if (static_cast<int>(scope.free.size()) >= options.max_bundle_keyframes) break;
    scope.free.insert(neighbour.id);
  }
  for (const KeyframeId id : scope.free) {
    for (const LandmarkId landmark : map.GetKeyframe(id).landmarks) {
      if (landmark.valid()) scope.landmarks.insert(landmark);
    }
  }
  scope.fixed = FindFixed(map, scope, options.max_fixed_keyframes);
  if (scope.fixed.empty() || scope.free.contains(KeyframeId(0))) {
    // Something must hold the frame of reference: the oldest keyframe.
    const KeyframeId oldest = *scope.free.begin();
    scope.free.erase(oldest);
    scope.fixed.insert(oldest);
  }
  if (!scope.free.empty()) Solve(scope, options.bundle, model, stop, map);
}

std::optional<MapCorrection> ComputeWholeAdjustment(const MapSnapshot& map,
                                                    const MeasurementModel& model,
                                                    const BundleOptions& bundle,
                                                    std::stop_token stop) {
  AdjustmentScope scope;
  for (const SubmapSize& submap : FindSubmaps(map)) {
    scope.fixed.insert(FindWorldHolder(map, submap.id));
  }
  if (scope.fixed.empty()) return {};
  map.keyframes.ForEach([&](const Keyframe& keyframe) {
    if (!scope.fixed.contains(keyframe.id)) scope.free.insert(keyframe.id);
  });
  map.landmarks.ForEach([&](const Landmark& landmark) { scope.landmarks.insert(landmark.id); });
  const MapExtract extract = Extract(map.keyframes, map.landmarks, scope, model);
  const BundleResult result = AdjustBundle(model.camera, extract.problem, bundle, stop);
  if (!result.usable) return {};
  return MakeCorrection(extract, result);
}

void AdjustWholeMap(Map& map, const MeasurementModel& model, const MappingOptions& options,
                    std::stop_token stop) {
  const std::optional<MapCorrection> correction =
      ComputeWholeAdjustment(*map.Snapshot(), model, options.final_bundle, stop);
  if (correction) ApplyCorrection(*correction, map);
}

}  // namespace ofm
