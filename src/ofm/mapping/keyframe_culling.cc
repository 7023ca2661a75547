#include "ofm/mapping/keyframe_culling.h"

#include <memory>
#include <optional>
#include <queue>
#include <set>
#include <tuple>

#include "ofm/map/covisibility.h"
#include "ofm/map/submap.h"

namespace ofm {
namespace {

constexpr int kOtherObservers = 3;

/// How many other keyframes, three at most, see the landmark at a scale not coarser than `octave` +
/// 1.
int CountOthers(const Map& map, const Landmark& landmark, KeyframeId self, int octave) {
  int others = 0;
  for (const Landmark::Observation& o : landmark.observations) {
    if (o.keyframe == self) continue;
    const int other_octave = map.GetKeyframe(o.keyframe).features->keypoints[o.feature].octave;
    if (other_octave <= octave + 1 && ++others >= kOtherObservers) break;
  }
  return others;
}

/// How well others see a keyframe's close landmarks.
struct Redundancy {
  double seen_by_three = 0;   ///< share of them
  double seen_by_others = 0;  ///< mean share of three others
};

/// Empty where it has none.
std::optional<Redundancy> RedundancyOf(const Map& map, const Keyframe& keyframe,
                                       const MeasurementModel& model) {
  int close = 0, by_three = 0, others = 0;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    const LandmarkId id = keyframe.landmarks[i];
    const float depth = keyframe.features->depth_m[i];
    if (!id.valid() || depth <= 0 || depth > model.CloseDepth()) continue;
    ++close;
    const int seen =
        CountOthers(map, map.GetLandmark(id), keyframe.id, keyframe.features->keypoints[i].octave);
    others += seen;
    by_three += seen == kOtherObservers ? 1 : 0;
  }
  if (close == 0) return {};
  return Redundancy{static_cast<double>(by_three) / close,
                    static_cast<double>(others) / (kOtherObservers * close)};
}

double SeenByOthers(const Map& map, const Keyframe& keyframe, const MeasurementModel& model) {
  const auto redundancy = RedundancyOf(map, keyframe, model);
  return redundancy ? redundancy->seen_by_others : 0;
}

/// Removes a keyframe if another is there to keep the poses that refer to it.
void RemoveIfAnchored(Map& map, KeyframeId id) {
  const std::vector<CovisibleKeyframe> anchors = FindCovisible(map, id);
  if (!anchors.empty()) map.RemoveKeyframe(id, anchors.front().id);
}

/// What the budget must not touch.
std::set<KeyframeId> FindIndispensable(Map& map, KeyframeId current) {
  std::set<KeyframeId> kept = {current};
  for (const CovisibleKeyframe& neighbour : FindCovisible(map, current)) kept.insert(neighbour.id);
  const std::shared_ptr<const MapSnapshot> snapshot = map.Snapshot();
  for (const SubmapSize& submap : FindSubmaps(*snapshot)) {
    kept.insert(FindWorldHolder(*snapshot, submap.id));
  }
  return kept;
}

struct Candidate {
  double redundancy = 0;
  KeyframeId id;
  /// The most redundant is the greatest, of equals the oldest.
  bool operator<(const Candidate& other) const {
    return std::tie(redundancy, other.id) < std::tie(other.redundancy, id);
  }
};

}  // namespace

void RemoveRedundantKeyframes(Map& map, KeyframeId current, const MeasurementModel& model,
                              const MappingOptions& options) {
  for (const CovisibleKeyframe& neighbour : FindCovisible(map, current)) {
    if (neighbour.id == KeyframeId(0)) continue;
    const auto redundancy = RedundancyOf(map, map.GetKeyframe(neighbour.id), model);
    if (redundancy && redundancy->seen_by_three >= options.redundant_share) {
      RemoveIfAnchored(map, neighbour.id);
    }
  }
}

void RemoveKeyframesOverBudget(Map& map, KeyframeId current, const MeasurementModel& model,
                               const MappingOptions& options) {
  const auto budget = static_cast<std::size_t>(options.max_keyframes);
  if (map.keyframes().size() <= budget) return;
  const std::set<KeyframeId> indispensable = FindIndispensable(map, current);
  std::priority_queue<Candidate> candidates;
  map.keyframes().ForEach([&](const Keyframe& keyframe) {
    if (indispensable.contains(keyframe.id)) return;
    candidates.push({SeenByOthers(map, keyframe, model), keyframe.id});
  });
  while (map.keyframes().size() > budget - budget / 16 && !candidates.empty()) {
    Candidate most = candidates.top();
    candidates.pop();
    // Less than it was where others are gone since: it may not be the next any more.
    most.redundancy = SeenByOthers(map, map.GetKeyframe(most.id), model);
    if (!candidates.empty() && most < candidates.top()) {
      candidates.push(most);
    } else {
      RemoveIfAnchored(map, most.id);
    }
  }
}

}  // namespace ofm
