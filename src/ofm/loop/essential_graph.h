// The pose graph of a map: the keyframes, and the pairs of them that hold one another.
#pragma once

#include <vector>

#include "ofm/map/map.h"

namespace ofm {

/// Two keyframes that share landmarks; `a` is the older one.
struct CovisibilityEdge {
  KeyframeId a, b;
  int shared_landmarks = 0;  ///< 0 where nothing but their order joins them
  bool operator==(const CovisibilityEdge&) const = default;
};

/// A spanning tree of most shared landmarks of a sub-map, and all of its pairs that share at least
/// `strong_covisibility` (Mur-Artal, Montiel and Tardos 2015, section III-D). Parts of it that
/// share nothing are joined where they follow one another. In increasing order of (a, b).
std::vector<CovisibilityEdge> EssentialGraph(const MapSnapshot& map, SubmapId submap,
                                             int strong_covisibility);

}  // namespace ofm
