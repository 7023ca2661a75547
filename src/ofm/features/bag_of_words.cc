#include "ofm/features/bag_of_words.h"

#include <algorithm>

namespace ofm {
namespace {

/// Of sorted words: the first of each keeps the sum of all.
void MergeEqualWords(BagOfWords& words) {
  std::size_t kept = 0;
  for (const WeightedWord& word : words) {
    if (kept > 0 && words[kept - 1].word == word.word) {
      words[kept - 1].weight += word.weight;
    } else {
      words[kept++] = word;
    }
  }
  words.resize(kept);
}

}  // namespace

BagOfWords MakeBagOfWords(std::vector<WeightedWord> words) {
  std::ranges::stable_sort(words, {}, &WeightedWord::word);
  MergeEqualWords(words);
  std::erase_if(words, [](const WeightedWord& word) { return !(word.weight > 0); });
  double sum = 0;
  for (const WeightedWord& word : words) sum += word.weight;
  for (WeightedWord& word : words) word.weight = static_cast<float>(word.weight / sum);
  return words;
}

double Similarity(const BagOfWords& a, const BagOfWords& b) {
  // With |a| = |b| = 1, 1 - |a - b| / 2 is the sum of the smaller weights of the common words.
  double common = 0;
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() && j != b.end()) {
    if (i->word < j->word) {
      ++i;
    } else if (j->word < i->word) {
      ++j;
    } else {
      common += std::min(i++->weight, j++->weight);
    }
  }
  return common;
}

}  // namespace ofm
