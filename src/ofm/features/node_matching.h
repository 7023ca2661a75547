// Descriptor matching within the nodes of a vocabulary tree.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ofm/features/matching.h"

namespace ofm {

/// Descriptors and, by feature, the node that each belongs to (PlaceDescription::nodes).
struct IndexedDescriptors {
  std::span<const Descriptor> descriptors;
  std::span<const std::uint32_t> nodes;
};

/// Nearest neighbours as of MatchBruteForce, among features of the same node alone: for images of
/// the same place, most of the matches at a small part of the time (Galvez-Lopez and Tardos, 2012,
/// section IV). In the order of `a`.
std::vector<FeatureMatch> MatchByNode(const IndexedDescriptors& a, const IndexedDescriptors& b,
                                      const MatchOptions& options = {});

}  // namespace ofm
