// Whether a frame should become a keyframe.
#pragma once

#include "ofm/tracking/measurement.h"
#include "ofm/tracking/options.h"
#include "ofm/tracking/tracking_types.h"

namespace ofm {

/// What the decision looks at.
struct KeyframeEvidence {
  int frames_since_keyframe = 0;
  int inliers = 0;
  int reference_landmarks = 0;  ///< well observed ones of the reference keyframe
  int close_tracked = 0;        ///< close features that show a landmark
  int close_untracked = 0;      ///< close features that could make one
  int keyframes_waiting = 0;
};

/// Landmarks of `keyframe` that have at least `min_observations` observers.
int CountWellObserved(const MapSnapshot& map, const Keyframe& keyframe, int min_observations);

/// Gathers the evidence for a tracked frame.
KeyframeEvidence GatherKeyframeEvidence(const MeasurementModel& model, const TrackingInput& input,
                                        const TrackingResult& result, FrameId last_keyframe);

/// Inliers under a share of the reference's, or too few close points while more are to be had; not
/// while mapping is too far behind.
bool NeedsKeyframe(const KeyframeEvidence& evidence, const KeyframeOptions& options);

}  // namespace ofm
