#include "ofm/objects/object_association.h"

#include <algorithm>
#include <optional>
#include <tuple>

namespace ofm {
namespace {

/// A pair that may be one thing.
struct Pair {
  double value = 0;  // overlap, or nearness
  std::size_t first = 0, second = 0;

  /// The best first.
  friend bool operator<(const Pair& a, const Pair& b) {
    return std::make_tuple(-a.value, a.first, a.second) <
           std::make_tuple(-b.value, b.first, b.second);
  }
};

/// How much two overlap where that makes them one; empty where it does not.
std::optional<double> Overlap(const ObjectHypothesis& a, const ObjectHypothesis& b,
                              const ObjectJoinOptions& options) {
  if (!a.IsNear(b)) return {};
  const double a_in_b = a.ShareIn(b), b_in_a = b.ShareIn(a);
  const bool same = a.IsLikely(b.BestClass()) || b.IsLikely(a.BestClass());
  const double overlap = same ? std::max(a_in_b, b_in_a) : std::min(a_in_b, b_in_a);
  if (overlap < (same ? options.same_class_overlap : options.other_class_overlap)) return {};
  return overlap;
}

/// True where `seen` is a second instance beside one of the same class in the same key frame.
bool IsBesideKnown(const ObjectHypothesis& seen, const ObjectHypothesis& known, double voxel_m) {
  constexpr double kSameMask = 0.5;
  const PlacedObservation& now = seen.observations().front();
  for (const PlacedObservation& other : known.observations()) {
    if (other.keyframe != now.keyframe || other.class_id != now.class_id) continue;
    ObjectHypothesis alone(voxel_m);
    alone.Add(other);
    if (std::max(alone.ShareIn(seen), seen.ShareIn(alone)) < kSameMask) return true;
  }
  return false;
}

/// Share of the views of the one with fewer, in which key frames saw two things of one class.
double SeenApartShare(const ObjectHypothesis& a, const ObjectHypothesis& b) {
  int apart = 0;
  for (const auto& [keyframe, score] : a.views()) {
    if (!b.views().contains(keyframe)) continue;
    const bool two = std::any_of(a.class_weights().begin(), a.class_weights().end(),
                                 [&, id = keyframe](const auto& weight) {
                                   return a.SawIn(id, weight.first) && b.SawIn(id, weight.first);
                                 });
    if (two) ++apart;
  }
  return static_cast<double>(apart) /
         static_cast<double>(std::min(a.views().size(), b.views().size()));
}

/// The distance, negative, of two that are at one place; empty where they are not.
std::optional<double> Nearness(const ObjectHypothesis& a, const ObjectHypothesis& b,
                               const ObjectJoinOptions& options) {
  constexpr double kLikeSize = 0.5;
  const Spread of_a = a.FindSpread(), of_b = b.FindSpread();
  const double distance_m = (of_a.center - of_b.center).norm();
  const auto [small_m, large_m] = std::minmax(of_a.radius_m, of_b.radius_m);
  const bool same = a.IsLikely(b.BestClass()) || b.IsLikely(a.BestClass());
  if (!same && small_m < kLikeSize * large_m) return {};
  const double limit_m =
      same ? options.same_class_spreads * large_m : options.other_class_spreads * small_m;
  if (distance_m >= limit_m) return {};
  if (SeenApartShare(a, b) > 0) return {};
  return -distance_m;
}

/// The pair for which `measure` gives most; empty where it gives nothing for any.
template <class Measure>
std::optional<Pair> BestPair(const std::vector<ObjectHypothesis>& hypotheses, Measure&& measure) {
  std::optional<Pair> best;
  for (std::size_t i = 0; i < hypotheses.size(); ++i) {
    for (std::size_t j = i + 1; j < hypotheses.size(); ++j) {
      const std::optional<double> value = measure(hypotheses[i], hypotheses[j]);
      if (value && (!best || Pair{*value, i, j} < *best)) best = Pair{*value, i, j};
    }
  }
  return best;
}

/// Merges the best pair again and again.
template <class Measure>
void MergePairs(std::vector<ObjectHypothesis>& hypotheses, Measure&& measure) {
  while (const auto pair = BestPair(hypotheses, measure)) {
    hypotheses[pair->first].Absorb(hypotheses[pair->second]);
    hypotheses.erase(hypotheses.begin() + static_cast<std::ptrdiff_t>(pair->second));
  }
}

bool IsPartOf(const ObjectHypothesis& part, const ObjectHypothesis& whole,
              const ObjectJoinOptions& options) {
  return part.Weight() <= options.part_max_weight * whole.Weight() && part.Size() <= whole.Size() &&
         part.Size() >= options.part_min_size * whole.Size() &&
         part.ShareIn(whole) >= options.part_overlap;
}

}  // namespace

void AssociateKeyframe(std::vector<PlacedObservation> observations,
                       const ObjectJoinOptions& options,
                       std::vector<ObjectHypothesis>& hypotheses) {
  std::vector<ObjectHypothesis> seen;
  for (PlacedObservation& observation : observations) {
    seen.emplace_back(options.voxel_m).Add(std::move(observation));
  }
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t j = 0; j < hypotheses.size(); ++j) {
      if (const auto overlap = Overlap(seen[i], hypotheses[j], options)) {
        pairs.push_back({*overlap, i, j});
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> done(seen.size(), false);
  for (const Pair& pair : pairs) {
    if (done[pair.first]) continue;
    ObjectHypothesis& known = hypotheses[pair.second];
    if (IsBesideKnown(seen[pair.first], known, options.voxel_m)) continue;
    known.Absorb(seen[pair.first]);
    done[pair.first] = true;
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!done[i]) hypotheses.push_back(std::move(seen[i]));
  }
}

void MergeHypotheses(const ObjectJoinOptions& options, std::vector<ObjectHypothesis>& hypotheses) {
  MergePairs(hypotheses, [&](const auto& a, const auto& b) -> std::optional<double> {
    const auto overlap = Overlap(a, b, options);
    if (!overlap || SeenApartShare(a, b) > options.max_seen_apart_share) return {};
    return overlap;
  });
}

void MergeNear(const ObjectJoinOptions& options, std::vector<ObjectHypothesis>& hypotheses) {
  MergePairs(hypotheses, [&](const auto& a, const auto& b) { return Nearness(a, b, options); });
}

void DropParts(const ObjectJoinOptions& options, std::vector<ObjectHypothesis>& hypotheses) {
  const std::vector<ObjectHypothesis> all = hypotheses;
  std::erase_if(hypotheses, [&](const ObjectHypothesis& part) {
    return std::any_of(all.begin(), all.end(), [&](const ObjectHypothesis& whole) {
      return whole.IsNear(part) && IsPartOf(part, whole, options);
    });
  });
}

}  // namespace ofm
