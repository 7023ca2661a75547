#include "ofm/io/association.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>

#include "ofm/base/check.h"

namespace ofm {
namespace {

struct Candidate {
  std::int64_t difference_ns;
  StampPair pair;
};

/// All pairs within the limit, found by a window that moves along both lists.
std::vector<Candidate> FindCandidates(std::span<const std::int64_t> first,
                                      std::span<const std::int64_t> second,
                                      std::int64_t max_difference_ns) {
  std::vector<Candidate> candidates;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    while (begin < second.size() && second[begin] <= first[i] - max_difference_ns) ++begin;
    for (std::size_t j = begin; j < second.size() && second[j] < first[i] + max_difference_ns;
         ++j) {
      candidates.push_back({std::abs(second[j] - first[i]), {i, j}});
    }
  }
  return candidates;
}

}  // namespace

std::vector<StampPair> AssociateStamps(std::span<const std::int64_t> first,
                                       std::span<const std::int64_t> second,
                                       std::int64_t max_difference_ns) {
  OFM_CHECK(std::is_sorted(first.begin(), first.end()));
  OFM_CHECK(std::is_sorted(second.begin(), second.end()));
  std::vector<Candidate> candidates = FindCandidates(first, second, max_difference_ns);
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.difference_ns, a.pair.first, a.pair.second) <
           std::tie(b.difference_ns, b.pair.first, b.pair.second);
  });

  std::vector<char> first_taken(first.size()), second_taken(second.size());
  std::vector<StampPair> pairs;
  for (const auto& [difference_ns, pair] : candidates) {
    if (first_taken[pair.first] || second_taken[pair.second]) continue;
    first_taken[pair.first] = second_taken[pair.second] = 1;
    pairs.push_back(pair);
  }
  std::sort(pairs.begin(), pairs.end(), [](StampPair a, StampPair b) { return a.first < b.first; });
  return pairs;
}

std::size_t NearestStamp(std::span<const std::int64_t> stamps, std::int64_t stamp_ns) {
  OFM_CHECK(!stamps.empty());
  const auto after = std::lower_bound(stamps.begin(), stamps.end(), stamp_ns);
  const std::size_t index = static_cast<std::size_t>(after - stamps.begin());
  if (index == 0) return 0;
  if (index == stamps.size()) return index - 1;
  return stamps[index] - stamp_ns < stamp_ns - stamps[index - 1] ? index : index - 1;
}

}  // namespace ofm
