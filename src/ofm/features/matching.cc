#include "ofm/features/matching.h"

#include <cstdint>

#include "ofm/features/hamming.h"

namespace ofm {
namespace {

constexpr int kFar = 257;

struct Nearest {
  int index = -1;
  int distance = kFar;
  int second_distance = kFar;

  void Add(int candidate, int candidate_distance) {
    if (candidate_distance < distance) {
      second_distance = distance;
      distance = candidate_distance;
      index = candidate;
    } else if (candidate_distance < second_distance) {
      second_distance = candidate_distance;
    }
  }
};

bool IsDistinct(const Nearest& nearest, const MatchOptions& options) {
  if (nearest.index < 0 || nearest.distance > options.max_distance) return false;
  return options.max_ratio >= 1 || nearest.second_distance == kFar ||
         nearest.distance < options.max_ratio * nearest.second_distance;
}

}  // namespace

std::vector<FeatureMatch> MatchBruteForce(std::span<const Descriptor> a,
                                          std::span<const Descriptor> b,
                                          const MatchOptions& options) {
  std::vector<Nearest> nearest_of_a(a.size()), nearest_of_b(b.size());
  std::vector<std::uint16_t> distances(b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    HammingDistances(a[i], b, distances);
    for (std::size_t j = 0; j < b.size(); ++j) {
      nearest_of_a[i].Add(static_cast<int>(j), distances[j]);
      nearest_of_b[j].Add(static_cast<int>(i), distances[j]);
    }
  }
  std::vector<FeatureMatch> matches;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Nearest& nearest = nearest_of_a[i];
    if (!IsDistinct(nearest, options)) continue;
    const int index = static_cast<int>(i);
    if (options.cross_check && nearest_of_b[nearest.index].index != index) continue;
    matches.push_back({index, nearest.index, nearest.distance});
  }
  return matches;
}

}  // namespace ofm
