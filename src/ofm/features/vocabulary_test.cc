#include "ofm/features/vocabulary.h"

#include <gmock/gmock.h>

#include <limits>

#include "ofm/features/test_vocabulary.h"

namespace ofm {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Vocabulary, KnowsItsSize) {
  const Vocabulary small(SmallTree());
  EXPECT_EQ(small.word_count(), 3U);
  EXPECT_EQ(small.node_count(), 5U);
  EXPECT_EQ(small.branching(), 2);
  EXPECT_EQ(small.depth(), 2);
  EXPECT_EQ(Vocabulary(RegularTree(7)).word_count(), 49U);
}

TEST(Vocabulary, GoesDownToTheNearestWord) {
  const VocabularyTree tree = SmallTree();
  const Vocabulary vocabulary(tree);
  RandomEngine engine = MakeRandomEngine(1, 0);
  EXPECT_EQ(vocabulary.WordOf(Disturbed(tree.descriptors[2], 20, engine)), 0U);
  // Nearest to node 1 first, and there to one of its children.
  const Descriptor& parent = tree.descriptors[1];
  const bool left =
      HammingDistance(parent, tree.descriptors[3]) <= HammingDistance(parent, tree.descriptors[4]);
  EXPECT_EQ(vocabulary.WordOf(parent), left ? 1U : 2U);
}

TEST(Vocabulary, WeighsWordsByCountTimesIdf) {
  const VocabularyTree tree = SmallTree();
  const Vocabulary vocabulary(tree);
  const Descriptor& a = tree.descriptors[2];
  const Descriptor& b = tree.descriptors[1];
  const std::uint32_t word = vocabulary.WordOf(b);
  const float a_weight = 3 * tree.idf[0], b_weight = tree.idf[word], sum = a_weight + b_weight;
  EXPECT_THAT(vocabulary.Describe(std::vector{a, b, a, a}).words,
              ElementsAre(WeightedWord{0, a_weight / sum}, WeightedWord{word, b_weight / sum}));
}

TEST(Vocabulary, IndexesFeaturesByTheNodeOfTheLevelAskedFor) {
  const VocabularyTree tree = SmallTree();
  const Vocabulary vocabulary(tree);
  const std::vector<Descriptor> features = {tree.descriptors[2], tree.descriptors[1]};
  EXPECT_THAT(vocabulary.Describe(features, 0).nodes, ElementsAre(0, 0));
  EXPECT_THAT(vocabulary.Describe(features, 1).nodes, ElementsAre(2, 1));
  // Node 2 has no children: it is the lowest of its branch.
  const std::uint32_t leaf = 2 + vocabulary.WordOf(tree.descriptors[1]);
  EXPECT_THAT(vocabulary.Describe(features, 2).nodes, ElementsAre(2, leaf));
  EXPECT_THAT(vocabulary.Describe(features, 9).nodes, ElementsAre(2, leaf));
  EXPECT_THROW(vocabulary.Describe(features, -1), std::logic_error);
}

TEST(Vocabulary, GivesTheSameWordsWhateverTheOrderOfTheFeatures) {
  const Vocabulary vocabulary(RegularTree(10));
  std::vector<Descriptor> features = RandomDescriptors(300, 5);
  const BagOfWords words = vocabulary.Describe(features).words;
  std::ranges::reverse(features);
  EXPECT_EQ(vocabulary.Describe(features).words, words);
}

TEST(Vocabulary, DescribesAnImageWithoutFeaturesByNoWord) {
  const PlaceDescription description = Vocabulary(SmallTree()).Describe({});
  EXPECT_THAT(description.words, IsEmpty());
  EXPECT_THAT(description.nodes, IsEmpty());
}

TEST(Vocabulary, IsOfAnyDepth) {
  VocabularyTree chain;  // each node has one child
  chain.child_counts.assign(400, 1);
  chain.child_counts.back() = 0;
  chain.descriptors = RandomDescriptors(400, 1);
  chain.idf = {1};
  EXPECT_EQ(Vocabulary(chain).depth(), 399);
  EXPECT_EQ(Vocabulary(chain).WordOf({}), 0U);
}

TEST(VocabularyTree, FaultsAreFound) {
  EXPECT_EQ(FindFault(SmallTree()), "");
  EXPECT_THAT(FindFault({}), HasSubstr("no word"));
  EXPECT_THAT(FindFault({{0}, RandomDescriptors(1, 1), {1}}), HasSubstr("no word"));

  VocabularyTree tree = SmallTree();
  tree.descriptors.pop_back();
  EXPECT_THAT(FindFault(tree), HasSubstr("descriptor"));
  tree = SmallTree();
  tree.child_counts = {2, 2, 0, 1, 0};  // a child too many
  EXPECT_THAT(FindFault(tree), HasSubstr("one tree"));
  tree = SmallTree();
  tree.child_counts = {1, 0, 2, 0, 0};  // node 2 is nobody's child
  EXPECT_THAT(FindFault(tree), HasSubstr("one tree"));
  tree = SmallTree();
  tree.idf.push_back(1);
  EXPECT_THAT(FindFault(tree), HasSubstr("weight"));
  for (const float wrong :
       {-1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    tree = SmallTree();
    tree.idf[1] = wrong;
    EXPECT_THAT(FindFault(tree), HasSubstr("weight"));
  }
  EXPECT_THROW(Vocabulary{tree}, std::logic_error);
}

}  // namespace
}  // namespace ofm
