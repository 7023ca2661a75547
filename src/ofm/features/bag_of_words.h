// An image as the visual words that it shows.
#pragma once

#include <cstdint>
#include <vector>

namespace ofm {

/// A word of a vocabulary and how much it says of an image.
struct WeightedWord {
  std::uint32_t word = 0;
  float weight = 0;
  bool operator==(const WeightedWord&) const = default;
};

/// The words of an image in increasing order, each once. Weights are positive and add up to 1; an
/// image without any telling word has none.
using BagOfWords = std::vector<WeightedWord>;

/// Sorts `words`, adds up the weights of equal ones, drops what has no weight and normalises the
/// rest.
BagOfWords MakeBagOfWords(std::vector<WeightedWord> words);

/// How alike two images are: 1 - |a - b|_1 / 2, from 0 (no common word) to 1 (Nister and Stewenius,
/// "Scalable recognition with a vocabulary tree", 2006; Galvez-Lopez and Tardos, "Bags of binary
/// words for fast place recognition in image sequences", 2012). 0 where either has no word.
double Similarity(const BagOfWords& a, const BagOfWords& b);

}  // namespace ofm
