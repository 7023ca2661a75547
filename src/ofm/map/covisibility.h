// Which keyframes see the same landmarks. Counted when asked, so it is never stale.
#pragma once

#include <vector>

#include "ofm/map/map.h"

namespace ofm {

struct CovisibleKeyframe {
  KeyframeId id;
  int shared_landmarks = 0;
};

/// Keyframes that share landmarks with `id` (itself left out), most shared first, equal ones by id.
/// `FindLandmark` and `FindKeyframe` of Map or MapSnapshot are used through the two overloads.
std::vector<CovisibleKeyframe> FindCovisible(const Map& map, KeyframeId id, int min_shared = 15);
std::vector<CovisibleKeyframe> FindCovisible(const MapSnapshot& map, KeyframeId id,
                                             int min_shared = 15);

/// Keyframes by how many of `landmarks` each sees, most first; invalid and gone ids are ignored.
std::vector<CovisibleKeyframe> CountObservers(const MapSnapshot& map,
                                              const std::vector<LandmarkId>& landmarks);

}  // namespace ofm
