// Descriptor matching without any idea of the motion: for relocalisation.
#pragma once

#include <span>
#include <vector>

#include "ofm/base/options.h"
#include "ofm/features/features.h"

namespace ofm {

struct MatchOptions {
  int max_distance = 64;    ///< Hamming, of 256 bits
  double max_ratio = 0.8;   ///< nearest over second nearest distance; 1 = no such test
  bool cross_check = true;  ///< each must be the other's nearest

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("max_distance", self.max_distance, "largest Hamming distance [bits]", Range{0, 256});
    visit("max_ratio", self.max_ratio, "nearest over second nearest distance", Range{0, 1});
    visit("cross_check", self.cross_check, "each must be the other's nearest");
  }
};

struct FeatureMatch {
  int a = 0, b = 0;  ///< indices into the two lists
  int distance = 0;  ///< Hamming [bits]
  bool operator==(const FeatureMatch&) const = default;
};

/// Nearest neighbours in `b` of each of `a` (of equals the first), in the order of `a`.
std::vector<FeatureMatch> MatchBruteForce(std::span<const Descriptor> a,
                                          std::span<const Descriptor> b,
                                          const MatchOptions& options = {});

}  // namespace ofm
