#include "ofm/features/descriptor_clusters.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "ofm/features/test_descriptors.h"

namespace ofm {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::SizeIs;

TEST(Majority, HasTheBitsOfMostDescriptors) {
  const Descriptor a{0b1100}, b{0b1010}, c{0b1001};
  EXPECT_EQ(MajorityOf(std::vector{a, b, c}), (Descriptor{0b1000}));
  EXPECT_EQ(MajorityOf(std::vector{a, a, b, b}), (Descriptor{0b1000}));
}

TEST(Majority, CountsBitByBitOverThousandsOfDescriptors) {
  const std::vector<Descriptor> descriptors = RandomDescriptors(1001, 3);
  const Descriptor majority = MajorityOf(descriptors);
  for (std::size_t bit = 0; bit < 256; ++bit) {
    const auto is_set = [bit](const Descriptor& d) { return (d[bit / 64] >> (bit % 64) & 1) == 1; };
    EXPECT_EQ(is_set(majority), std::ranges::count_if(descriptors, is_set) > 500) << bit;
  }
}

TEST(DescriptorClusters, FindTheGroupsThatThereAre) {
  RandomEngine engine = MakeRandomEngine(1, 0);
  const std::vector<Descriptor> centres = RandomDescriptors(5, 2);
  const std::vector<Descriptor> descriptors = DescriptorsNear(centres, 60, engine);
  const DescriptorClusters clusters = ClusterDescriptors(descriptors, 5, 20, engine);
  EXPECT_THAT(clusters.centres, testing::UnorderedElementsAreArray(centres));
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    EXPECT_EQ(clusters.centres[clusters.cluster_of[i]], centres[i % 5]);
  }
}

TEST(DescriptorClusters, GiveEveryDescriptorItsNearestCentre) {
  RandomEngine engine = MakeRandomEngine(1, 0);
  const std::vector<Descriptor> descriptors = RandomDescriptors(400, 4);
  const DescriptorClusters clusters = ClusterDescriptors(descriptors, 8, 1000, engine);
  std::set<int> used;
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    used.insert(clusters.cluster_of[i]);
    const int own = HammingDistance(descriptors[i], clusters.centres[clusters.cluster_of[i]]);
    for (const Descriptor& centre : clusters.centres) {
      EXPECT_LE(own, HammingDistance(descriptors[i], centre));
    }
  }
  EXPECT_EQ(used.size(), clusters.centres.size());
}

TEST(DescriptorClusters, AreAsManyAsThereAreDifferentDescriptors) {
  RandomEngine engine = MakeRandomEngine(1, 0);
  const std::vector<Descriptor> two = RandomDescriptors(2, 5);
  const std::vector<Descriptor> descriptors = {two[0], two[1], two[0], two[0], two[1]};
  EXPECT_THAT(ClusterDescriptors(descriptors, 10, 5, engine).centres, SizeIs(2));
  const DescriptorClusters one = ClusterDescriptors(std::vector(4, two[0]), 10, 5, engine);
  EXPECT_THAT(one.centres, ElementsAre(two[0]));
  EXPECT_THAT(one.cluster_of, Each(0));
}

TEST(DescriptorClusters, AreNeverEmptyHoweverSoonTheyEnd) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    RandomEngine engine = MakeRandomEngine(seed, 0);
    const std::vector<Descriptor> descriptors = RandomDescriptors(40, seed);
    const DescriptorClusters clusters = ClusterDescriptors(descriptors, 20, 1, engine);
    const std::set<int> used(clusters.cluster_of.begin(), clusters.cluster_of.end());
    EXPECT_EQ(used.size(), clusters.centres.size());
    EXPECT_EQ(*used.rbegin() + 1, static_cast<int>(clusters.centres.size()));
  }
}

TEST(DescriptorClusters, AreTheSameForTheSameEngine) {
  const std::vector<Descriptor> descriptors = RandomDescriptors(300, 6);
  RandomEngine one = MakeRandomEngine(1, 0), same = MakeRandomEngine(1, 0);
  const DescriptorClusters a = ClusterDescriptors(descriptors, 7, 10, one);
  const DescriptorClusters b = ClusterDescriptors(descriptors, 7, 10, same);
  EXPECT_EQ(a.centres, b.centres);
  EXPECT_EQ(a.cluster_of, b.cluster_of);
}

TEST(DescriptorClusters, RejectImpossibleCounts) {
  RandomEngine engine = MakeRandomEngine(1, 0);
  const std::vector<Descriptor> some = RandomDescriptors(9, 6);
  EXPECT_THROW(ClusterDescriptors({}, 2, 1, engine), std::logic_error);
  EXPECT_THROW(ClusterDescriptors(some, 1, 1, engine), std::logic_error);
  EXPECT_THROW(ClusterDescriptors(some, 256, 1, engine), std::logic_error);
}

}  // namespace
}  // namespace ofm
