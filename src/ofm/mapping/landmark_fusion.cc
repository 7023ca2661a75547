#include "ofm/mapping/landmark_fusion.h"

#include <set>

#include "ofm/estimation/reprojection.h"
#include "ofm/map/covisibility.h"
#include "ofm/map/projection.h"

namespace ofm {
namespace {

/// The feature of the keyframe that shows the landmark by place and descriptor; -1 where none does.
int FindInKeyframe(const Keyframe& keyframe, const Landmark& landmark,
                   const MeasurementModel& model, int max_hamming) {
  constexpr float kRadiusPx = 3;
  const auto projection =
      ProjectLandmark(model.camera, keyframe.camera_from_world, landmark, model.scales);
  if (!projection) return -1;
  FeatureQuery query;
  query.ideal_px = projection->ideal_px.cast<float>();
  query.radius_px = kRadiusPx * model.scales.Scale(projection->octave);
  query.min_octave = projection->octave - 1;
  query.max_octave = projection->octave;
  query.descriptor = landmark.descriptor;
  const Eigen::Vector3d point_in_camera = keyframe.camera_from_world * landmark.position_in_world;
  const FeatureCandidate found = FindFeature(*keyframe.features, query, [&](int feature) {
    const PointObservation seen = model.Observe(*keyframe.features, feature);
    return ReprojectionChiSquare(model.camera, point_in_camera, seen) <= ChiSquareGate(seen);
  });
  return found.distance <= max_hamming ? found.feature : -1;
}

/// Fuses landmarks into a keyframe; returns how many were fused with others.
int FuseInto(Map& map, KeyframeId target, const std::vector<LandmarkId>& landmarks,
             const MeasurementModel& model, const MappingOptions& options) {
  int fused = 0;
  for (const LandmarkId id : landmarks) {
    const Landmark* landmark = map.landmarks().Find(id);
    if (landmark == nullptr || landmark->FeatureIn(target) >= 0) continue;
    const Keyframe& keyframe = map.GetKeyframe(target);
    const int feature = FindInKeyframe(keyframe, *landmark, model, options.max_hamming);
    if (feature < 0) continue;
    const LandmarkId other = keyframe.landmarks[feature];
    if (!other.valid()) {
      map.AddObservation(id, target, feature);
      continue;
    }
    ++fused;
    if (map.GetLandmark(other).observations.size() > landmark->observations.size()) {
      map.Fuse(id, other);
    } else {
      map.Fuse(other, id);
    }
  }
  return fused;
}

std::vector<LandmarkId> LandmarksOf(const Map& map, KeyframeId id) {
  std::vector<LandmarkId> landmarks;
  for (const LandmarkId landmark : map.GetKeyframe(id).landmarks) {
    if (landmark.valid()) landmarks.push_back(landmark);
  }
  return landmarks;
}

/// The best neighbours and a few of theirs.
std::vector<KeyframeId> FusionTargets(const Map& map, KeyframeId current, int neighbours) {
  constexpr int kSecondNeighbours = 5;
  std::vector<KeyframeId> targets;
  std::set<KeyframeId> known{current};
  const auto add_best = [&](KeyframeId of, int count) {
    for (const CovisibleKeyframe& neighbour : FindCovisible(map, of)) {
      if (count-- <= 0) break;
      if (known.insert(neighbour.id).second) targets.push_back(neighbour.id);
    }
  };
  add_best(current, neighbours);
  const std::size_t first = targets.size();
  for (std::size_t i = 0; i < first; ++i) add_best(targets[i], kSecondNeighbours);
  return targets;
}

}  // namespace

int FuseWithNeighbours(Map& map, KeyframeId current, const MeasurementModel& model,
                       const MappingOptions& options) {
  const std::vector<KeyframeId> targets = FusionTargets(map, current, options.neighbours);
  int fused = 0;
  const std::vector<LandmarkId> mine = LandmarksOf(map, current);
  for (const KeyframeId target : targets) fused += FuseInto(map, target, mine, model, options);
  std::set<LandmarkId> theirs;
  for (const KeyframeId target : targets) {
    for (const LandmarkId id : LandmarksOf(map, target)) theirs.insert(id);
  }
  fused += FuseInto(map, current, {theirs.begin(), theirs.end()}, model, options);
  for (const LandmarkId id : LandmarksOf(map, current)) map.RefreshLandmark(id);
  return fused;
}

}  // namespace ofm
