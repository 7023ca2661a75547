#include "ofm/features/default_vocabulary.h"

#include <gtest/gtest.h>

#include <thread>

#include "ofm/features/orb_extractor.h"
#include "ofm/features/vocabulary_file.h"
#include "ofm/io/read_file.h"
#include "ofm/sim/sim_sequence.h"

namespace ofm {
namespace {

TEST(DefaultVocabulary, IsTheFileOfTheSources) {
  EXPECT_EQ(EncodeVocabulary(DefaultVocabulary()),
            ReadFile(OFM_SOURCE_DIR "/src/ofm/features/default_vocabulary.bin"));
}

TEST(DefaultVocabulary, HasWordsEnough) {
  EXPECT_GT(DefaultVocabulary().word_count(), 3000U);
  EXPECT_GE(DefaultVocabulary().depth(), Vocabulary::kIndexDepth + 1);
}

TEST(DefaultVocabulary, IsOneForAllThreads) {
  const Vocabulary* first = nullptr;
  const Vocabulary* second = nullptr;
  {
    const std::jthread a([&] { first = &DefaultVocabulary(); });
    const std::jthread b([&] { second = &DefaultVocabulary(); });
  }
  EXPECT_EQ(first, second);
}

TEST(DefaultVocabulary, TellsAViewNearbyFromOneTheOtherWay) {
  SimSequenceOptions options;
  options.seed = 4711;  // a room that it was not made from
  options.frames = 9;
  options.rate_hz = 9 / 24.0;
  options.path.kind = CameraPathKind::kTour;
  options.noise.model = NoiseModel::kKinect;
  SimSequence tour(options);
  OrbExtractor extractor(OrbOptions{.count = 500});
  const auto words = [&](const SimSequence& sequence, std::uint32_t frame) {
    const Features features = extractor.Extract(sequence.Frame(FrameId(frame)).gray);
    return DefaultVocabulary().Describe(features.descriptors).words;
  };
  options.rate_hz = 3;
  const SimSequence slow(options);  // its second frame is a few degrees on
  const double near = Similarity(words(tour, 0), words(slow, 1));
  const double far = Similarity(words(tour, 0), words(tour, 4));
  EXPECT_GT(near, 1.5 * far) << "near " << near << ", far " << far;
}

}  // namespace
}  // namespace ofm
