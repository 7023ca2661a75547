#include "ofm/loop/loop_detector.h"

#include <algorithm>

#include "ofm/map/covisibility.h"

namespace ofm {
namespace {

/// The keyframe and those that share landmarks with it.
std::set<KeyframeId> NeighbourhoodOf(const MapSnapshot& map, KeyframeId id) {
  std::set<KeyframeId> neighbourhood{id};
  for (const CovisibleKeyframe& neighbour : FindCovisible(map, id)) {
    neighbourhood.insert(neighbour.id);
  }
  return neighbourhood;
}

/// The keyframe, its neighbours and theirs: mapping holds these together without loops.
std::set<KeyframeId> SurroundingsOf(const MapSnapshot& map, KeyframeId id) {
  std::set<KeyframeId> surroundings;
  for (const KeyframeId neighbour : NeighbourhoodOf(map, id)) {
    surroundings.merge(NeighbourhoodOf(map, neighbour));
  }
  return surroundings;
}

bool Intersect(const std::set<KeyframeId>& a, const std::set<KeyframeId>& b) {
  return std::any_of(a.begin(), a.end(), [&](KeyframeId id) { return b.contains(id); });
}

}  // namespace

void LoopDetector::Add(KeyframeId id, const BagOfWords& words) {
  database_.Add(id, words);
  rows_.clear();
  last_ = id;
}

/// Keyframes out of the surroundings of `id` that look about as much like it as its neighbours do.
std::vector<KeyframeId> LoopDetector::FindSimilar(const MapSnapshot& map, KeyframeId id,
                                                  const BagOfWords& words) {
  PlaceQuery query;
  double best_neighbour = 0;
  query.excluded = SurroundingsOf(map, id);
  for (const KeyframeId neighbour : NeighbourhoodOf(map, id)) {
    const BagOfWords* theirs = database_.Find(neighbour);
    if (theirs == nullptr || neighbour == id) continue;
    best_neighbour = std::max(best_neighbour, Similarity(words, *theirs));
  }
  if (best_neighbour == 0) return {};
  query.min_similarity = options_.similarity_share * best_neighbour;
  std::vector<KeyframeId> similar;
  for (const SimilarPlace& place : database_.Query(words, query)) {
    if (map.keyframes.Find(place.keyframe) == nullptr) {
      database_.Remove(place.keyframe);
    } else {
      similar.push_back(place.keyframe);
    }
  }
  return similar;
}

LoopCandidates LoopDetector::Detect(const MapSnapshot& map, KeyframeId id,
                                    const BagOfWords& words) {
  LoopCandidates candidates;
  // A row ends where the camera was lost.
  if (map.FindSubmap(last_) != map.FindSubmap(id)) rows_.clear();
  last_ = id;
  std::vector<Row> rows;
  for (const KeyframeId similar : FindSimilar(map, id, words)) {
    ++candidates.similar;
    Row row{NeighbourhoodOf(map, similar), 1};
    for (const Row& last : rows_) {
      if (Intersect(row.places, last.places)) {
        row.keyframes = std::max(row.keyframes, last.keyframes + 1);
      }
    }
    const bool is_enough = row.keyframes >= options_.consistent_keyframes &&
                           static_cast<int>(candidates.consistent.size()) < options_.max_candidates;
    if (is_enough) candidates.consistent.push_back(similar);
    rows.push_back(std::move(row));
  }
  rows_ = std::move(rows);
  database_.Add(id, words);
  return candidates;
}

}  // namespace ofm
