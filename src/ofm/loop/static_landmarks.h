// What stands still, of keyframes: nothing else takes part in places and loops.
#pragma once

#include <vector>

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

/// Descriptors of the keyframe's static features.
inline std::vector<Descriptor> StaticDescriptors(const MapSnapshot& map, const Keyframe& keyframe,
                                                 double min_probability) {
  std::vector<Descriptor> descriptors;
  for (std::size_t i = 0; i < keyframe.features->size(); ++i) {
    if (IsStatic(map, keyframe, static_cast<int>(i), min_probability)) {
      descriptors.push_back(keyframe.features->descriptors[i]);
    }
  }
  return descriptors;
}

}  // namespace ofm
