#include "ofm/features/bag_of_words.h"

#include <gmock/gmock.h>

#include "ofm/base/random.h"

namespace ofm {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

BagOfWords RandomBag(std::uint64_t seed) {
  RandomEngine engine = MakeRandomEngine(seed, 0);
  std::vector<WeightedWord> words;
  for (int i = 0; i < 40; ++i) {
    words.push_back({UniformIndex(engine, 60), static_cast<float>(UniformReal(engine))});
  }
  return MakeBagOfWords(words);
}

/// The definition, word by word.
double SimilarityByDefinition(const BagOfWords& a, const BagOfWords& b) {
  std::vector<double> difference(60, 0);
  for (const WeightedWord& word : a) difference[word.word] += word.weight;
  for (const WeightedWord& word : b) difference[word.word] -= word.weight;
  double norm = 0;
  for (const double d : difference) norm += std::abs(d);
  return 1 - norm / 2;
}

TEST(BagOfWords, HasEachWordOnceInOrderWithWeightsThatAddUpToOne) {
  const BagOfWords bag = MakeBagOfWords({{7, 1}, {2, 3}, {7, 2}, {4, 2}});
  EXPECT_THAT(
      bag, ElementsAre(WeightedWord{2, 0.375F}, WeightedWord{4, 0.25F}, WeightedWord{7, 0.375F}));
}

TEST(BagOfWords, DropsWordsWithoutWeight) {
  EXPECT_THAT(MakeBagOfWords({{1, 0}, {2, 5}, {3, 0}}), ElementsAre(WeightedWord{2, 1}));
  EXPECT_THAT(MakeBagOfWords({{1, 0}}), IsEmpty());
  EXPECT_THAT(MakeBagOfWords({}), IsEmpty());
}

TEST(Similarity, IsOneLessHalfTheL1Distance) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const BagOfWords a = RandomBag(seed), b = RandomBag(seed + 100);
    EXPECT_NEAR(Similarity(a, b), SimilarityByDefinition(a, b), 1e-6);
    EXPECT_EQ(Similarity(a, b), Similarity(b, a));
  }
}

TEST(Similarity, IsOneForTheSameImageAndZeroWithoutACommonWord) {
  EXPECT_NEAR(Similarity(RandomBag(1), RandomBag(1)), 1, 1e-6);
  EXPECT_EQ(Similarity({{1, 0.5F}, {3, 0.5F}}, {{2, 0.5F}, {4, 0.5F}}), 0);
}

TEST(Similarity, IsZeroWhereAnImageHasNoWord) {
  EXPECT_EQ(Similarity({}, RandomBag(1)), 0);
  EXPECT_EQ(Similarity({}, {}), 0);
}

}  // namespace
}  // namespace ofm
