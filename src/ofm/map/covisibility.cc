#include "ofm/map/covisibility.h"

#include <algorithm>

namespace ofm {
namespace {

template <class FindLandmark>
std::vector<CovisibleKeyframe> Count(const std::vector<LandmarkId>& landmarks,
                                     FindLandmark&& find_landmark) {
  std::vector<int> counts;  // by keyframe id
  for (const LandmarkId id : landmarks) {
    const Landmark* landmark = id.valid() ? find_landmark(id) : nullptr;
    if (landmark == nullptr) continue;
    for (const Landmark::Observation& o : landmark->observations) {
      if (o.keyframe.value >= counts.size()) counts.resize(o.keyframe.value + 1, 0);
      ++counts[o.keyframe.value];
    }
  }
  std::vector<CovisibleKeyframe> result;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) result.push_back({KeyframeId(static_cast<std::uint32_t>(i)), counts[i]});
  }
  std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) {
    return a.shared_landmarks > b.shared_landmarks;
  });
  return result;
}

std::vector<CovisibleKeyframe> KeepNeighbours(std::vector<CovisibleKeyframe> all, KeyframeId self,
                                              int min_shared) {
  std::erase_if(all, [&](const CovisibleKeyframe& k) {
    return k.id == self || k.shared_landmarks < min_shared;
  });
  return all;
}

}  // namespace

std::vector<CovisibleKeyframe> FindCovisible(const Map& map, KeyframeId id, int min_shared) {
  const auto find = [&](LandmarkId landmark) { return map.FindLandmark(landmark); };
  return KeepNeighbours(Count(map.GetKeyframe(id).landmarks, find), id, min_shared);
}

std::vector<CovisibleKeyframe> FindCovisible(const MapSnapshot& map, KeyframeId id,
                                             int min_shared) {
  const Keyframe* keyframe = map.keyframes.Find(id);
  if (keyframe == nullptr) return {};
  const auto find = [&](LandmarkId landmark) { return map.FindLandmark(landmark); };
  return KeepNeighbours(Count(keyframe->landmarks, find), id, min_shared);
}

std::vector<CovisibleKeyframe> CountObservers(const MapSnapshot& map,
                                              const std::vector<LandmarkId>& landmarks) {
  return Count(landmarks, [&](LandmarkId landmark) { return map.FindLandmark(landmark); });
}

}  // namespace ofm
