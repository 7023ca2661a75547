#include "ofm/features/static_words.h"

namespace ofm {

BagOfWords StaticWords(const FrameFeatures& features, const Vocabulary& vocabulary,
                       double min_probability) {
  std::vector<Descriptor> descriptors;
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (features.StaticProbability(static_cast<int>(i)) < min_probability) continue;
    descriptors.push_back(features.descriptors[i]);
  }
  return vocabulary.Describe(descriptors).words;
}

}  // namespace ofm
