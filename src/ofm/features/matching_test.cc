#include "ofm/features/matching.h"

#include <gmock/gmock.h>

#include "ofm/features/hamming.h"
#include "ofm/features/test_descriptors.h"

namespace ofm {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// With its lowest `bits` bits turned.
Descriptor WithBitsTurned(Descriptor descriptor, int bits) {
  for (int i = 0; i < bits; ++i) descriptor[i / 64] ^= std::uint64_t{1} << (i % 64);
  return descriptor;
}

TEST(HammingDistances, EqualTheDistancesOneByOne) {
  const std::vector<Descriptor> train = RandomDescriptors(37, 1);
  const Descriptor query = RandomDescriptors(1, 2)[0];
  std::vector<std::uint16_t> distances(train.size());
  HammingDistances(query, train, distances);
  for (std::size_t i = 0; i < train.size(); ++i) {
    EXPECT_EQ(distances[i], HammingDistance(query, train[i]));
  }
}

TEST(HammingDistances, ReachFromNoneToAllBits) {
  const Descriptor zero{}, ones = WithBitsTurned(zero, 256);
  std::vector<std::uint16_t> distances(2);
  HammingDistances(zero, std::vector<Descriptor>{zero, ones}, distances);
  EXPECT_THAT(distances, ElementsAre(0, 256));
}

TEST(HammingDistances, RejectAnOutputOfAnotherLength) {
  std::vector<std::uint16_t> distances(2);
  EXPECT_THROW(HammingDistances({}, RandomDescriptors(3, 1), distances), std::logic_error);
}

TEST(MatchBruteForce, FindsEachShuffledDescriptor) {
  const std::vector<Descriptor> a = RandomDescriptors(50, 3);
  std::vector<Descriptor> b(a.rbegin(), a.rend());
  for (Descriptor& descriptor : b) descriptor = WithBitsTurned(descriptor, 9);
  const auto matches = MatchBruteForce(a, b);
  ASSERT_EQ(matches.size(), 50u);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(matches[i], (FeatureMatch{i, 49 - i, 9}));
}

TEST(MatchBruteForce, IsEmptyWhereAListIsEmpty) {
  const std::vector<Descriptor> some = RandomDescriptors(3, 1);
  EXPECT_THAT(MatchBruteForce({}, some), IsEmpty());
  EXPECT_THAT(MatchBruteForce(some, {}), IsEmpty());
}

TEST(MatchBruteForce, DropsWhatIsTooFar) {
  const std::vector<Descriptor> a = RandomDescriptors(1, 4);
  const std::vector<Descriptor> b = {WithBitsTurned(a[0], 31)};
  EXPECT_THAT(MatchBruteForce(a, b, {.max_distance = 30}), IsEmpty());
  EXPECT_THAT(MatchBruteForce(a, b, {.max_distance = 31}), ElementsAre(FeatureMatch{0, 0, 31}));
}

TEST(MatchBruteForce, DropsWhatHasTwoNearNeighbours) {
  const std::vector<Descriptor> a = RandomDescriptors(1, 5);
  const std::vector<Descriptor> b = {WithBitsTurned(a[0], 20), WithBitsTurned(a[0], 18)};
  EXPECT_THAT(MatchBruteForce(a, b, {.max_ratio = 0.9}), IsEmpty());
  EXPECT_THAT(MatchBruteForce(a, b, {.max_ratio = 0.91}), ElementsAre(FeatureMatch{0, 1, 18}));
}

TEST(MatchBruteForce, CrossCheckLeavesEachFeatureOneMatch) {
  const Descriptor target = RandomDescriptors(1, 6)[0];
  const std::vector<Descriptor> a = {WithBitsTurned(target, 10), WithBitsTurned(target, 3)};
  const std::vector<Descriptor> b = {target};
  EXPECT_THAT(MatchBruteForce(a, b), ElementsAre(FeatureMatch{1, 0, 3}));
  EXPECT_THAT(MatchBruteForce(a, b, {.cross_check = false}),
              ElementsAre(FeatureMatch{0, 0, 10}, FeatureMatch{1, 0, 3}));
}

}  // namespace
}  // namespace ofm
