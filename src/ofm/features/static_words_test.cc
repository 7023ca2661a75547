#include "ofm/features/static_words.h"

#include <gtest/gtest.h>

#include "ofm/base/random.h"
#include "ofm/features/default_vocabulary.h"

namespace ofm {
namespace {

FrameFeatures MakeFeatures(int count) {
  RandomEngine engine = MakeRandomEngine(1, 0);
  FrameFeatures features;
  for (int i = 0; i < count; ++i) {
    features.keypoints.emplace_back();
    features.descriptors.push_back({engine(), engine(), engine(), engine()});
  }
  return features;
}

TEST(StaticWords, AreThoseOfAllFeaturesWhereNothingIsToldOfMotion) {
  const FrameFeatures features = MakeFeatures(50);
  EXPECT_EQ(StaticWords(features, DefaultVocabulary()),
            DefaultVocabulary().Describe(features.descriptors).words);
  EXPECT_FALSE(StaticWords(features, DefaultVocabulary()).empty());
}

TEST(StaticWords, LeaveOutWhatMoves) {
  FrameFeatures features = MakeFeatures(50);
  FrameFeatures still = features;
  still.descriptors.resize(20);
  for (int i = 0; i < 50; ++i) features.static_probability.push_back(i < 20 ? 0.5F : 0.49F);
  EXPECT_EQ(StaticWords(features, DefaultVocabulary()),
            DefaultVocabulary().Describe(still.descriptors).words);
  EXPECT_EQ(StaticWords(features, DefaultVocabulary(), 0.4),
            StaticWords(MakeFeatures(50), DefaultVocabulary()));
}

TEST(StaticWords, OfNothingAreNone) {
  EXPECT_TRUE(StaticWords(MakeFeatures(0), DefaultVocabulary()).empty());
}

}  // namespace
}  // namespace ofm
