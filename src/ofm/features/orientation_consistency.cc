#include "ofm/features/orientation_consistency.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "ofm/base/check.h"

namespace ofm {
namespace {

/// Bins are centred on multiples of their width, so that a difference of 0 lies amid one.
int BinOf(const AnglePair& pair, int bins) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const double turns = (static_cast<double>(pair.b_rad) - pair.a_rad) / kTurn;
  const auto bin = std::lround((turns - std::floor(turns)) * bins);
  return static_cast<int>(bin % bins);
}

}  // namespace

std::vector<bool> ConsistentOrientations(std::span<const AnglePair> pairs, int bins,
                                         int kept_bins) {
  OFM_CHECK(bins > 0 && kept_bins > 0);
  std::vector<int> counts(bins, 0), order(bins);
  for (const AnglePair& pair : pairs) ++counts[BinOf(pair, bins)];
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return counts[a] > counts[b]; });
  std::vector<bool> is_kept(bins, false);
  for (int i = 0; i < std::min(kept_bins, bins); ++i) {
    is_kept[order[i]] = 10 * counts[order[i]] >= counts[order[0]];
  }
  std::vector<bool> is_consistent;
  is_consistent.reserve(pairs.size());
  for (const AnglePair& pair : pairs) is_consistent.push_back(is_kept[BinOf(pair, bins)]);
  return is_consistent;
}

}  // namespace ofm
