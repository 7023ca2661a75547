#include "ofm/tracking/relocalizer.h"

#include <algorithm>

#include "ofm/features/static_words.h"
#include "ofm/map/covisibility.h"

namespace ofm {
namespace {

/// Keyframes by similarity to the frame, the most similar first, of equals the older.
std::vector<KeyframeId> RankByAppearance(const TrackingInput& input) {
  struct Ranked {
    KeyframeId id;
    double similarity;
  };
  const BagOfWords words = StaticWords(*input.features, *input.map->vocabulary);
  std::vector<Ranked> ranked;
  input.map->keyframes.ForEach([&](const Keyframe& keyframe) {
    const double similarity = keyframe.words ? Similarity(words, *keyframe.words) : 0;
    if (similarity > 0) ranked.push_back({keyframe.id, similarity});
  });
  std::ranges::stable_sort(ranked, std::greater<>(), &Ranked::similarity);
  std::vector<KeyframeId> ids;
  for (const Ranked& keyframe : ranked) ids.push_back(keyframe.id);
  return ids;
}

/// The pose from one keyframe; a second guided search finds what a poor first pose did not.
TrackingResult TryKeyframe(const PoseSearch& search, const TrackingInput& input,
                           const Keyframe& keyframe) {
  TrackingResult result;
  result.status = TrackingStatus::kLost;
  const auto estimate = search.FromKeyframe(input, keyframe, search.options().pnp.min_inliers);
  if (!estimate) return result;
  result = search.InLocalMap(input, *estimate);
  if (!HasPose(result.status)) return result;
  if (result.inliers < search.options().min_relocalization_inliers) {
    result = search.InLocalMap(input, PoseSearch::EstimateOf(input, result));
  }
  return result;
}

}  // namespace

std::vector<KeyframeId> FindRelocalizationCandidates(const TrackingInput& input,
                                                     KeyframeId last_reference,
                                                     const RelocalizationOptions& options) {
  std::vector<KeyframeId> candidates;
  const auto add = [&](KeyframeId id) {
    if (std::ranges::find(candidates, id) == candidates.end()) candidates.push_back(id);
  };
  std::size_t limit = options.similar_keyframes;
  for (const KeyframeId id : RankByAppearance(input)) {
    if (candidates.size() < limit) add(id);
  }
  limit = candidates.size() + options.near_keyframes;
  if (input.map->keyframes.Find(last_reference) != nullptr && candidates.size() < limit) {
    add(last_reference);
    for (const CovisibleKeyframe& near : FindCovisible(*input.map, last_reference)) {
      if (candidates.size() < limit) add(near.id);
    }
  }
  std::vector<KeyframeId> all;
  input.map->keyframes.ForEach([&](const Keyframe& keyframe) { all.push_back(keyframe.id); });
  if (options.spread_keyframes == 0) return candidates;
  const std::size_t step = std::max<std::size_t>(1, all.size() / options.spread_keyframes);
  for (std::size_t i = input.frame_id.value % step; i < all.size(); i += step) add(all[i]);
  return candidates;
}

std::optional<TrackingResult> Relocalize(const PoseSearch& search, const TrackingInput& input,
                                         KeyframeId last_reference) {
  const TrackingOptions& options = search.options();
  for (const KeyframeId id :
       FindRelocalizationCandidates(input, last_reference, options.relocalization)) {
    TrackingResult result = TryKeyframe(search, input, *input.map->keyframes.Find(id));
    if (!HasPose(result.status) || result.inliers < options.min_relocalization_inliers) continue;
    result.status = TrackingStatus::kRelocalized;
    return result;
  }
  return {};
}

}  // namespace ofm
