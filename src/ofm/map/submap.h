// Parts of a map whose places relative to one another are not known.
#pragma once

#include <vector>

#include "ofm/map/map.h"

namespace ofm {

/// The keyframes that were made without the camera being lost in between, or that were joined since
/// by a place that both show. Each sub-map has a world of its own; no landmark is of two. A sub-map
/// has the number of the keyframe that began it; where two are joined, one of their numbers goes.
struct SubmapSize {
  SubmapId id;
  std::size_t keyframes = 0;
};

/// The sub-maps that a map has, the oldest first.
std::vector<SubmapSize> FindSubmaps(const MapSnapshot& map);

/// The one with most keyframes, of equals the older; of an empty map the one that begins it.
SubmapId LargestSubmap(const MapSnapshot& map);

/// The keyframe that holds a sub-map's frame of reference when the others move: the one that began
/// it, or where that is gone the oldest. After a join that is not the oldest of all where the older
/// one joined the younger. Invalid where the sub-map has none.
KeyframeId FindWorldHolder(const MapSnapshot& map, SubmapId submap);

}  // namespace ofm
