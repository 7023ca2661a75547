#include "ofm/features/vocabulary_training.h"

#include <gmock/gmock.h>

#include <cmath>

#include "ofm/features/test_descriptors.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using ::testing::AllOf;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::Le;

constexpr VocabularyTrainingOptions kSmall{.branching = 4, .depth = 2, .min_split_descriptors = 8};

/// `count` images that show the same 12 things, and each one thing of its own.
std::vector<std::vector<Descriptor>> ImagesOfThings(int count) {
  RandomEngine engine = MakeRandomEngine(3, 0);
  const std::vector<Descriptor> common = RandomDescriptors(12, 1),
                                own = RandomDescriptors(count, 2);
  std::vector<std::vector<Descriptor>> images;
  for (int i = 0; i < count; ++i) {
    images.push_back(DescriptorsNear(common, 3, engine));
    for (int k = 0; k < 30; ++k) images.back().push_back(Disturbed(own[i], 12, engine));
  }
  return images;
}

Vocabulary Train(const std::vector<std::vector<Descriptor>>& images,
                 const VocabularyTrainingOptions& options) {
  return TrainVocabulary(images, options, MakeRandomEngine(1, 0)).value();
}

TEST(VocabularyTraining, MakesATreeOfTheShapeAskedFor) {
  const Vocabulary vocabulary = Train(ImagesOfThings(4), kSmall);
  EXPECT_EQ(vocabulary.branching(), 4);
  EXPECT_EQ(vocabulary.depth(), 2);
  EXPECT_THAT(vocabulary.word_count(), AllOf(Ge(12U), Le(16U)));
}

TEST(VocabularyTraining, TellsImagesOfTheSameThingsFromOthers) {
  const auto images = ImagesOfThings(4);
  const Vocabulary vocabulary = Train(images, {.branching = 4, .depth = 3});
  RandomEngine engine = MakeRandomEngine(9, 0);
  std::vector<Descriptor> again;
  for (const Descriptor& descriptor : images[2]) again.push_back(Disturbed(descriptor, 10, engine));
  const BagOfWords seen_again = vocabulary.Describe(again).words;
  const double same = Similarity(seen_again, vocabulary.Describe(images[2]).words);
  EXPECT_GT(same, 0.8);
  for (const int other : {0, 1, 3}) {
    EXPECT_LT(Similarity(seen_again, vocabulary.Describe(images[other]).words), 0.5 * same);
  }
}

TEST(VocabularyTraining, WeighsWordsByTheImagesThatHaveThem) {
  const auto images = ImagesOfThings(4);
  const Vocabulary vocabulary = Train(images, kSmall);
  std::vector<int> images_with(vocabulary.word_count(), 0);
  for (const auto& image : images) {
    std::vector<bool> has(vocabulary.word_count(), false);
    for (const Descriptor& descriptor : image) has[vocabulary.WordOf(descriptor)] = true;
    for (std::size_t word = 0; word < has.size(); ++word) images_with[word] += has[word];
  }
  for (std::size_t word = 0; word < images_with.size(); ++word) {
    EXPECT_FLOAT_EQ(vocabulary.tree().idf[word],
                    static_cast<float>(std::log(4.0 / std::max(images_with[word], 1))));
  }
}

TEST(VocabularyTraining, NodesWithFewDescriptorsStayWords) {
  const auto images = ImagesOfThings(4);  // 264 descriptors, which the root has all
  VocabularyTrainingOptions options{.branching = 4, .depth = 6, .min_split_descriptors = 264};
  EXPECT_EQ(Train(images, options).word_count(), 4U);
  options.min_split_descriptors = 10;
  EXPECT_GT(Train(images, options).word_count(), 12U);
}

TEST(VocabularyTraining, GivesTheSameTreeForTheSameEngine) {
  const auto images = ImagesOfThings(3);
  const VocabularyTree tree = Train(images, kSmall).tree();
  EXPECT_EQ(Train(images, kSmall).tree(), tree);
  EXPECT_NE(TrainVocabulary(images, kSmall, MakeRandomEngine(2, 0))->tree(), tree);
}

TEST(VocabularyTraining, ReportsProgressUpToOne) {
  std::vector<double> shares;
  TrainingWatch watch;
  watch.progress = [&](double share) { shares.push_back(share); };
  TrainVocabulary(ImagesOfThings(3), kSmall, MakeRandomEngine(1, 0), watch);
  ASSERT_GT(shares.size(), 3U);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_GT(shares.front(), 0);
  EXPECT_EQ(shares.back(), 1);
}

TEST(VocabularyTraining, StopsWhenAsked) {
  std::stop_source stop;
  TrainingWatch watch;
  watch.stop = stop.get_token();
  watch.progress = [&](double) { stop.request_stop(); };
  EXPECT_FALSE(TrainVocabulary(ImagesOfThings(3), kSmall, MakeRandomEngine(1, 0), watch));
}

TEST(VocabularyTraining, TooLittleToLearnFromIsAnError) {
  const auto train = [](std::vector<std::vector<Descriptor>> images) {
    return ErrorOf([&] { Train(images, kSmall); });
  };
  EXPECT_THAT(train({}), HasSubstr("two images"));
  EXPECT_THAT(train({RandomDescriptors(100, 1)}), HasSubstr("two images"));
  EXPECT_THAT(train({{}, {}}), HasSubstr("no features"));
  EXPECT_THAT(train({{Descriptor{}}, {Descriptor{}}}), HasSubstr("too few different features"));
}

}  // namespace
}  // namespace ofm
