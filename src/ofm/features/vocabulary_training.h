// Makes a vocabulary from the descriptors of many images.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "ofm/base/options.h"
#include "ofm/base/random.h"
#include "ofm/features/vocabulary.h"

namespace ofm {

struct VocabularyTrainingOptions {
  int branching = 10;              ///< children of a node at most
  int depth = 4;                   ///< levels below the root
  int max_iterations = 12;         ///< of k-means at a node
  int min_split_descriptors = 20;  ///< a node with fewer stays a word

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("branching", self.branching, "children of a node at most", Range{2, 255});
    visit("depth", self.depth, "levels below the root", Range{1, 10});
    visit("max_iterations", self.max_iterations, "of k-means at a node", Range{1, 1000});
    visit("min_split_descriptors", self.min_split_descriptors,
          "a node with fewer descriptors stays a word", Range{2, 1e9});
  }
};

/// How a training is watched and stopped; both may be left out.
struct TrainingWatch {
  std::function<void(double share)> progress;  ///< called with the share that is done, rising to 1
  std::stop_token stop;
};

/// Hierarchical k-means on the Hamming distance; then the words are weighted by how few of the
/// images have them. The same descriptors, options and engine give the same vocabulary. Empty where
/// it was stopped. Throws Error for under two images and for too few different descriptors.
std::optional<Vocabulary> TrainVocabulary(std::span<const std::vector<Descriptor>> images,
                                          const VocabularyTrainingOptions& options,
                                          RandomEngine engine, const TrainingWatch& watch = {});

}  // namespace ofm
