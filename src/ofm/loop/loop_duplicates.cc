#include "ofm/loop/loop_duplicates.h"

#include <set>

namespace ofm {
namespace {

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

}  // namespace

void AddDuplicates(const MapSnapshot& map, const VerifiedLoop& loop, const MeasurementModel& model,
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

}  // namespace ofm
