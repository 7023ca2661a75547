#include "ofm/mapping/keyframe_culling.h"

#include "ofm/map/covisibility.h"

namespace ofm {
namespace {

constexpr int kOtherObservers = 3;

/// True where enough other keyframes see the landmark at a scale not coarser than `octave` + 1.
bool IsSeenByOthers(const Map& map, const Landmark& landmark, KeyframeId self, int octave) {
  int others = 0;
  for (const Landmark::Observation& o : landmark.observations) {
    if (o.keyframe == self) continue;
    const int other_octave = map.GetKeyframe(o.keyframe).features->keypoints[o.feature].octave;
    if (other_octave <= octave + 1 && ++others >= kOtherObservers) return true;
  }
  return false;
}

bool IsRedundant(const Map& map, const Keyframe& keyframe, const MeasurementModel& model,
                 double share) {
  int close = 0, seen_by_others = 0;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    const LandmarkId id = keyframe.landmarks[i];
    const float depth = keyframe.features->depth_m[i];
    if (!id.valid() || depth <= 0 || depth > model.CloseDepth()) continue;
    ++close;
    const Landmark& landmark = map.GetLandmark(id);
    seen_by_others +=
        IsSeenByOthers(map, landmark, keyframe.id, keyframe.features->keypoints[i].octave);
  }
  return close > 0 && seen_by_others >= share * close;
}

}  // namespace

void RemoveRedundantKeyframes(Map& map, KeyframeId current, const MeasurementModel& model,
                              const MappingOptions& options) {
  for (const CovisibleKeyframe& neighbour : FindCovisible(map, current)) {
    if (neighbour.id == KeyframeId(0)) continue;
    if (!IsRedundant(map, map.GetKeyframe(neighbour.id), model, options.redundant_share)) continue;
    const std::vector<CovisibleKeyframe> anchors = FindCovisible(map, neighbour.id);
    if (!anchors.empty()) map.RemoveKeyframe(neighbour.id, anchors.front().id);
  }
}

}  // namespace ofm
