#include "ofm/features/descriptor_clusters.h"

#include <algorithm>
#include <array>

#include "ofm/base/check.h"
#include "ofm/features/hamming.h"

namespace ofm {
namespace {

/// Counts ones by bit, for many descriptors quickly: the bits of a byte are spread over the bytes
/// of a word, which add up without touching one another until one of them could overflow.
class BitCounter {
 public:
  void Add(const Descriptor& descriptor) {
    for (std::size_t byte = 0; byte < 32; ++byte) {
      sums_[byte] += kSpread[(descriptor[byte / 8] >> (byte % 8 * 8)) & 255];
    }
    if (++pending_ == 255) Flush();
  }

  /// The bits that more than half of the descriptors added have.
  Descriptor Majority() {
    Flush();
    Descriptor majority{};
    for (std::size_t bit = 0; bit < 256; ++bit) {
      if (2 * counts_[bit] > total_) majority[bit / 64] |= std::uint64_t{1} << (bit % 64);
    }
    return majority;
  }
  std::size_t total() const { return total_ + pending_; }

 private:
  static constexpr std::array<std::uint64_t, 256> kSpread = [] {
    std::array<std::uint64_t, 256> spread{};
    for (std::size_t value = 0; value < 256; ++value) {
      for (std::size_t bit = 0; bit < 8; ++bit) {
        spread[value] |= static_cast<std::uint64_t>((value >> bit) & 1) << (8 * bit);
      }
    }
    return spread;
  }();

  void Flush() {
    for (std::size_t bit = 0; bit < 256; ++bit) {
      counts_[bit] += (sums_[bit / 8] >> (bit % 8 * 8)) & 255;
    }
    sums_ = {};
    total_ += pending_;
    pending_ = 0;
  }

  std::array<std::uint64_t, 32> sums_{};
  std::array<std::size_t, 256> counts_{};
  std::size_t total_ = 0, pending_ = 0;
};

/// Centres far from one another: each is drawn with a chance in proportion to the squared distance
/// to the nearest of those before. Ends early where every descriptor is a centre.
std::vector<Descriptor> DrawCentres(std::span<const Descriptor> descriptors, int count,
                                    RandomEngine& engine) {
  const auto size = static_cast<std::uint32_t>(descriptors.size());
  std::vector<Descriptor> centres = {descriptors[UniformIndex(engine, size)]};
  std::vector<std::uint16_t> nearest(size, 256), distances(size);
  while (static_cast<int>(centres.size()) < count) {
    HammingDistances(centres.back(), descriptors, distances);
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < size; ++i) {
      nearest[i] = std::min(nearest[i], distances[i]);
      sum += static_cast<std::uint64_t>(nearest[i]) * nearest[i];
    }
    if (sum == 0) break;
    const auto drawn = static_cast<std::uint64_t>(UniformReal(engine) * static_cast<double>(sum));
    std::uint64_t passed = 0;
    std::size_t chosen = 0;
    for (std::size_t i = 0; i < size && passed <= drawn; ++i) {
      passed += static_cast<std::uint64_t>(nearest[i]) * nearest[i];
      chosen = i;
    }
    centres.push_back(descriptors[chosen]);
  }
  return centres;
}

/// Gives every descriptor its nearest centre; false where all had it already.
bool Assign(std::span<const Descriptor> descriptors, DescriptorClusters& clusters) {
  std::vector<std::uint16_t> found(clusters.centres.size());
  bool changed = false;
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    HammingDistances(descriptors[i], clusters.centres, found);
    const auto nearest = static_cast<std::uint8_t>(std::ranges::min_element(found) - found.begin());
    changed = changed || nearest != clusters.cluster_of[i];
    clusters.cluster_of[i] = nearest;
  }
  return changed;
}

/// Moves the centres to the majorities of their clusters and drops those whose cluster is empty.
void MoveCentres(std::span<const Descriptor> descriptors, DescriptorClusters& clusters) {
  std::vector<BitCounter> counters(clusters.centres.size());
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    counters[clusters.cluster_of[i]].Add(descriptors[i]);
  }
  std::vector<std::uint8_t> renamed(counters.size());
  clusters.centres.clear();
  for (std::size_t k = 0; k < counters.size(); ++k) {
    renamed[k] = static_cast<std::uint8_t>(clusters.centres.size());
    if (counters[k].total() > 0) clusters.centres.push_back(counters[k].Majority());
  }
  for (std::uint8_t& cluster : clusters.cluster_of) cluster = renamed[cluster];
}

}  // namespace

Descriptor MajorityOf(std::span<const Descriptor> descriptors) {
  BitCounter counter;
  for (const Descriptor& descriptor : descriptors) counter.Add(descriptor);
  return counter.Majority();
}

DescriptorClusters ClusterDescriptors(std::span<const Descriptor> descriptors, int max_clusters,
                                      int max_iterations, RandomEngine& engine) {
  OFM_CHECK(!descriptors.empty());
  OFM_CHECK(max_clusters >= 2 && max_clusters <= 255 && max_iterations >= 1);
  DescriptorClusters clusters{DrawCentres(descriptors, max_clusters, engine),
                              std::vector<std::uint8_t>(descriptors.size(), 0)};
  Assign(descriptors, clusters);
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    MoveCentres(descriptors, clusters);
    if (!Assign(descriptors, clusters)) break;
  }
  // The last assignment may have left a centre without any.
  std::vector<std::size_t> sizes(clusters.centres.size(), 0);
  for (const std::uint8_t cluster : clusters.cluster_of) ++sizes[cluster];
  if (std::ranges::find(sizes, 0U) != sizes.end()) MoveCentres(descriptors, clusters);
  return clusters;
}

}  // namespace ofm
