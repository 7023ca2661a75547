#include "ofm/features/node_matching.h"

#include <gmock/gmock.h>

#include "ofm/features/test_vocabulary.h"

namespace ofm {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(MatchByNode, MatchesFeaturesOfTheSameNodeAlone) {
  const std::vector<Descriptor> d = RandomDescriptors(3, 1);
  const std::vector<Descriptor> a = {d[0], d[1], d[2]}, b = {d[2], d[0], d[1]};
  const std::vector<std::uint32_t> a_nodes = {8, 5, 8}, b_nodes = {8, 8, 6};
  EXPECT_THAT(MatchByNode({a, a_nodes}, {b, b_nodes}),
              ElementsAre(FeatureMatch{0, 1, 0}, FeatureMatch{2, 0, 0}));
}

TEST(MatchByNode, EqualsBruteForceWhereAllAreOfOneNode) {
  RandomEngine engine = MakeRandomEngine(1, 0);
  const std::vector<Descriptor> a = RandomDescriptors(60, 2);
  const std::vector<Descriptor> b = DescriptorsNear(a, 1, engine);
  const std::vector<std::uint32_t> nodes(60, 3);
  const MatchOptions options{.max_distance = 10};
  EXPECT_EQ(MatchByNode({a, nodes}, {b, nodes}, options), MatchBruteForce(a, b, options));
}

TEST(MatchByNode, FindsMostMatchesOfDisturbedFeatures) {
  const Vocabulary vocabulary(RegularTree(10));
  RandomEngine engine = MakeRandomEngine(1, 0);
  const std::vector<Descriptor> a = DescriptorsNear(vocabulary.tree().descriptors, 1, engine);
  std::vector<Descriptor> b;
  for (const Descriptor& descriptor : a) b.push_back(Disturbed(descriptor, 5, engine));
  const auto a_nodes = vocabulary.Describe(a, 1).nodes, b_nodes = vocabulary.Describe(b, 1).nodes;
  const auto matches = MatchByNode({a, a_nodes}, {b, b_nodes}, {.max_ratio = 1});
  EXPECT_GT(matches.size(), a.size() * 7 / 10);
  int last = -1;
  for (const FeatureMatch& match : matches) {
    EXPECT_EQ(match.a, match.b);
    EXPECT_GT(match.a, last);
    last = match.a;
  }
}

TEST(MatchByNode, IsEmptyWhereAListIsEmptyOrNoNodeIsCommon) {
  const std::vector<Descriptor> d = RandomDescriptors(2, 1);
  const std::vector<std::uint32_t> nodes = {1, 2}, others = {3, 4};
  EXPECT_THAT(MatchByNode({d, nodes}, {d, others}), IsEmpty());
  EXPECT_THAT(MatchByNode({d, nodes}, {}), IsEmpty());
  EXPECT_THAT(MatchByNode({}, {d, nodes}), IsEmpty());
}

TEST(MatchByNode, RejectsListsOfDifferentLengths) {
  const std::vector<Descriptor> d = RandomDescriptors(2, 1);
  const std::vector<std::uint32_t> nodes = {1};
  EXPECT_THROW(MatchByNode({d, nodes}, {d, nodes}), std::logic_error);
}

}  // namespace
}  // namespace ofm
