// Clusters of binary descriptors.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ofm/base/random.h"
#include "ofm/features/features.h"

namespace ofm {

/// The bits that most of the descriptors have (of an even number's half, 0): the point with the
/// least sum of Hamming distances to them.
Descriptor MajorityOf(std::span<const Descriptor> descriptors);

struct DescriptorClusters {
  std::vector<Descriptor> centres;
  std::vector<std::uint8_t> cluster_of;  ///< by descriptor, index into centres
};

/// k-means on the Hamming distance with majorities as centres (Grana et al., "A fast approach for
/// integrating ORB descriptors in the bag of words model", 2013), from centres that k-means++
/// draws (Arthur and Vassilvitskii, 2007). At most `max_clusters` (2 to 255) clusters, none of them
/// empty; fewer where there are fewer different descriptors. Every descriptor belongs to the
/// nearest centre, of equals the first, unless `max_iterations` ended it.
DescriptorClusters ClusterDescriptors(std::span<const Descriptor> descriptors, int max_clusters,
                                      int max_iterations, RandomEngine& engine);

}  // namespace ofm
