// Whether a candidate really shows the same place, and where the camera then is.
#pragma once

#include <optional>
#include <vector>

#include "ofm/base/random.h"
#include "ofm/loop/loop_matching.h"
#include "ofm/loop/options.h"

namespace ofm {

/// A keyframe that shows an earlier place.
struct VerifiedLoop {
  KeyframeId keyframe, place;
  RigidTransform camera_from_world;    ///< of the keyframe, by the landmarks of the place
  RigidTransform place_from_keyframe;  ///< the same, of the two cameras
  std::vector<LoopMatch> matches;      ///< that agree with it
};

/// How far a check came.
enum class LoopVerdict { kFewMatches, kNoAlignment, kFewInliers, kVerified };

struct LoopVerification {
  LoopVerdict verdict = LoopVerdict::kFewMatches;
  std::optional<VerifiedLoop> loop;  ///< where verified
};

/// Geometry decides: a rigid transform (the scale is known) by RANSAC on landmarks matched by
/// descriptor, then a search for further landmarks with it, and a pose by all of these (Mur-Artal
/// and Tardos 2017, section III-D). `place` is out of sight of `keyframe`.
LoopVerification VerifyLoop(const MapSnapshot& map, KeyframeId keyframe, KeyframeId place,
                            const MeasurementModel& model, const LoopOptions& options,
                            RandomEngine& engine);

}  // namespace ofm
