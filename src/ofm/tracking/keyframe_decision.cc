#include "ofm/tracking/keyframe_decision.h"

#include <algorithm>

namespace ofm {
namespace {

/// Observers that a landmark needs: two, once there are so many keyframes that can have seen it.
int MinObservations(const MapSnapshot& map, SubmapId submap) {
  constexpr int kFew = 2;
  int keyframes = 0;
  for (std::uint32_t id = 0; id < map.keyframes.ids_issued() && keyframes <= kFew; ++id) {
    const Keyframe* keyframe = map.keyframes.Find(KeyframeId(id));
    keyframes += keyframe != nullptr && keyframe->submap == submap;
  }
  return keyframes <= kFew ? 1 : 2;
}

}  // namespace

int CountWellObserved(const MapSnapshot& map, const Keyframe& keyframe, int min_observations) {
  int count = 0;
  for (const LandmarkId id : keyframe.landmarks) {
    const Landmark* landmark = id.valid() ? map.FindLandmark(id) : nullptr;
    if (landmark != nullptr &&
        static_cast<int>(landmark->observations.size()) >= min_observations) {
      ++count;
    }
  }
  return count;
}

KeyframeEvidence GatherKeyframeEvidence(const MeasurementModel& model, const TrackingInput& input,
                                        const TrackingResult& result, FrameId last_keyframe) {
  KeyframeEvidence evidence;
  evidence.frames_since_keyframe = static_cast<int>(input.frame_id.value - last_keyframe.value);
  evidence.inliers = result.inliers;
  evidence.keyframes_waiting = input.keyframes_waiting;
  for (std::size_t i = 0; i < input.features->size(); ++i) {
    const float depth = input.features->depth_m[i];
    if (depth <= 0 || depth > model.CloseDepth()) continue;
    ++(result.landmarks[i].valid() ? evidence.close_tracked : evidence.close_untracked);
  }
  const Keyframe* reference = input.map->keyframes.Find(result.reference);
  if (reference != nullptr) {
    evidence.reference_landmarks =
        CountWellObserved(*input.map, *reference, MinObservations(*input.map, reference->submap));
  }
  return evidence;
}

bool NeedsKeyframe(const KeyframeEvidence& evidence, const KeyframeOptions& options) {
  if (evidence.inliers < options.min_inliers) return false;
  if (evidence.keyframes_waiting >= options.max_waiting) return false;
  const bool close_needed = evidence.close_tracked < options.close_tracked &&
                            evidence.close_untracked > options.close_untracked;
  const bool few = evidence.inliers < options.inlier_ratio * evidence.reference_landmarks;
  return few || close_needed || evidence.frames_since_keyframe >= options.max_frames;
}

}  // namespace ofm
