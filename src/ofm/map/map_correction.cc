#include "ofm/map/map_correction.h"

#include <optional>
#include <set>

#include "ofm/map/covisibility.h"

namespace ofm {
namespace {

/// Motion of the world about a keyframe: corrected_world_from_world.
using WorldMotions = std::map<KeyframeId, RigidTransform>;

bool IsSame(const RigidTransform& a, const RigidTransform& b) {
  return a.translation() == b.translation() && a.rotation().coeffs() == b.rotation().coeffs();
}

/// How the world about a keyframe that the correction does not know is to move.
RigidTransform MotionOfAdded(const Map& map, KeyframeId id, const WorldMotions& motions) {
  for (const CovisibleKeyframe& neighbour : FindCovisible(map, id, 1)) {
    const auto motion = motions.find(neighbour.id);
    if (motion != motions.end()) return motion->second;
  }
  const SubmapId submap = map.FindSubmap(id);
  for (auto later = motions.upper_bound(id); later != motions.begin(); --later) {
    const auto& [before, motion] = *std::prev(later);
    if (map.FindSubmap(before) == submap) return motion;
  }
  return {};
}

WorldMotions MoveKeyframes(const MapCorrection& correction, Map& map) {
  WorldMotions motions;
  for (const auto& [id, move] : correction.keyframes) {
    motions[id] = move.after.Inverse() * move.before;
  }
  std::vector<KeyframeId> ids;
  map.keyframes().ForEach([&](const Keyframe& keyframe) { ids.push_back(keyframe.id); });
  for (const KeyframeId id : ids) {
    const RigidTransform now = map.GetKeyframe(id).camera_from_world;
    const auto move = correction.keyframes.find(id);
    if (move != correction.keyframes.end() && IsSame(now, move->second.before)) {
      map.SetKeyframePose(id, move->second.after);
      continue;
    }
    if (move == correction.keyframes.end()) motions[id] = MotionOfAdded(map, id, motions);
    map.SetKeyframePose(id, now * motions[id].Inverse());
  }
  return motions;
}

/// The motion of the keyframe that made the landmark, or of the first that sees it.
RigidTransform MotionOf(const Landmark& landmark, const WorldMotions& motions) {
  auto motion = motions.find(landmark.first_keyframe);
  if (motion == motions.end()) motion = motions.find(landmark.observations.front().keyframe);
  return motion == motions.end() ? RigidTransform() : motion->second;
}

void MoveLandmarks(const MapCorrection& correction, const WorldMotions& motions, Map& map) {
  std::vector<std::pair<LandmarkId, Eigen::Vector3d>> places;
  map.landmarks().ForEach([&](const Landmark& landmark) {
    const Eigen::Vector3d& now = landmark.position_in_world;
    const auto move = correction.landmarks.find(landmark.id);
    const bool is_known = move != correction.landmarks.end() && move->second.before == now;
    places.emplace_back(landmark.id,
                        is_known ? move->second.after : MotionOf(landmark, motions) * now);
  });
  for (const auto& [id, place] : places) map.SetLandmarkPosition(id, place);
}

int RemoveWrong(const MapCorrection& correction, Map& map) {
  int removed = 0;
  for (const LandmarkSighting& sighting : correction.wrong) {
    const Landmark* landmark = map.landmarks().Find(sighting.landmark);
    if (landmark == nullptr || landmark->FeatureIn(sighting.keyframe) != sighting.feature) continue;
    map.RemoveObservation(sighting.landmark, sighting.keyframe);
    ++removed;
  }
  return removed;
}

void AddFound(const MapCorrection& correction, Map& map, CorrectionReport& report) {
  std::set<LandmarkId> known;
  for (const LandmarkSighting& sighting : correction.found) known.insert(sighting.landmark);
  for (const LandmarkSighting& sighting : correction.found) {
    const Landmark* landmark = map.landmarks().Find(sighting.landmark);
    const Keyframe* keyframe = map.FindKeyframe(sighting.keyframe);
    if (landmark == nullptr || keyframe == nullptr) continue;
    if (landmark->FeatureIn(sighting.keyframe) >= 0) continue;
    const LandmarkId shown = keyframe->landmarks[sighting.feature];
    if (!shown.valid()) {
      map.AddObservation(sighting.landmark, sighting.keyframe, sighting.feature);
      ++report.observations_added;
    } else if (!known.contains(shown)) {
      map.Fuse(shown, sighting.landmark);
      ++report.landmarks_fused;
    }
  }
}

}  // namespace

CorrectionReport ApplyCorrection(const MapCorrection& correction, Map& map) {
  CorrectionReport report;
  const WorldMotions motions = MoveKeyframes(correction, map);
  MoveLandmarks(correction, motions, map);
  if (correction.join) map.JoinSubmaps(correction.join->from, correction.join->into);
  report.observations_removed = RemoveWrong(correction, map);
  AddFound(correction, map, report);
  std::vector<LandmarkId> landmarks;
  map.landmarks().ForEach([&](const Landmark& landmark) { landmarks.push_back(landmark.id); });
  for (const LandmarkId id : landmarks) map.RefreshLandmark(id);
  return report;
}

}  // namespace ofm
