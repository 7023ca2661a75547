#include "ofm/loop/essential_graph.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "ofm/map/covisibility.h"

namespace ofm {
namespace {

/// Which parts of a graph hang together (union–find).
class Components {
 public:
  /// False where both are in one part already.
  bool Join(KeyframeId a, KeyframeId b) {
    const KeyframeId root_a = Root(a), root_b = Root(b);
    if (root_a == root_b) return false;
    parent_[root_b] = root_a;
    return true;
  }

 private:
  KeyframeId Root(KeyframeId id) {
    KeyframeId& parent = parent_.emplace(id, id).first->second;
    if (parent == id) return id;
    const KeyframeId root = Root(parent);
    parent_[id] = root;
    return root;
  }

  std::map<KeyframeId, KeyframeId> parent_;
};

/// All pairs, those that share most landmarks first, then in order; the pairs that only follow one
/// another last.
std::vector<CovisibilityEdge> AllPairs(const MapSnapshot& map, SubmapId submap) {
  std::vector<CovisibilityEdge> pairs;
  KeyframeId last;
  map.keyframes.ForEach([&](const Keyframe& keyframe) {
    if (keyframe.submap != submap) return;
    for (const CovisibleKeyframe& neighbour : FindCovisible(map, keyframe.id, 1)) {
      if (neighbour.id < keyframe.id) {
        pairs.push_back({neighbour.id, keyframe.id, neighbour.shared_landmarks});
      }
    }
    if (last.valid()) pairs.push_back({last, keyframe.id, 0});
    last = keyframe.id;
  });
  std::sort(pairs.begin(), pairs.end(), [](const auto& x, const auto& y) {
    return std::tuple(-x.shared_landmarks, x.a, x.b) < std::tuple(-y.shared_landmarks, y.a, y.b);
  });
  return pairs;
}

}  // namespace

std::vector<CovisibilityEdge> EssentialGraph(const MapSnapshot& map, SubmapId submap,
                                             int strong_covisibility) {
  Components components;
  std::vector<CovisibilityEdge> edges;
  for (const CovisibilityEdge& pair : AllPairs(map, submap)) {
    // Kruskal's order makes the tree one of most shared landmarks.
    const bool joins = components.Join(pair.a, pair.b);
    if (joins || (pair.shared_landmarks >= strong_covisibility && pair.shared_landmarks > 0)) {
      edges.push_back(pair);
    }
  }
  std::sort(edges.begin(), edges.end(), [](const auto& x, const auto& y) {
    return std::tuple(x.a, x.b) < std::tuple(y.a, y.b);
  });
  return edges;
}

}  // namespace ofm
