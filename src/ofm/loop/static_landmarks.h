// What stands still, of keyframes: nothing else takes part in loops.
#pragma once

#include "ofm/map/map.h"

namespace ofm {

/// True where the landmark that the feature shows, if any, and the feature itself are static with
/// at least `min_probability`.
inline bool IsStatic(const MapSnapshot& map, const Keyframe& keyframe, int feature,
                     double min_probability) {
  if (keyframe.features->StaticProbability(feature) < min_probability) return false;
  const Landmark* landmark = map.FindLandmark(keyframe.landmarks[feature]);
  return landmark == nullptr || landmark->static_probability >= min_probability;
}

}  // namespace ofm
