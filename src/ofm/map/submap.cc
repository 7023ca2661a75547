#include "ofm/map/submap.h"

#include <algorithm>

namespace ofm {

std::vector<SubmapSize> FindSubmaps(const MapSnapshot& map) {
  std::map<SubmapId, std::size_t> counts;
  map.keyframes.ForEach([&](const Keyframe& keyframe) { ++counts[keyframe.submap]; });
  std::vector<SubmapSize> submaps;
  for (const auto& [id, keyframes] : counts) submaps.push_back({id, keyframes});
  return submaps;
}

SubmapId LargestSubmap(const MapSnapshot& map) {
  const std::vector<SubmapSize> submaps = FindSubmaps(map);
  const auto largest = std::ranges::max_element(submaps, {}, &SubmapSize::keyframes);
  return largest == submaps.end() ? SubmapId(0) : largest->id;
}

KeyframeId FindWorldHolder(const MapSnapshot& map, SubmapId submap) {
  const Keyframe* first = map.keyframes.Find(KeyframeId(submap.value));
  if (first != nullptr && first->submap == submap) return first->id;
  KeyframeId oldest;
  map.keyframes.ForEach([&](const Keyframe& keyframe) {
    if (!oldest.valid() && keyframe.submap == submap) oldest = keyframe.id;
  });
  return oldest;
}

}  // namespace ofm
