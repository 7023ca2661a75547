#include "ofm/features/place_database.h"

#include <algorithm>

#include "ofm/base/check.h"

namespace ofm {

void PlaceDatabase::Add(KeyframeId keyframe, BagOfWords words) {
  OFM_CHECK(keyframe.valid());
  Remove(keyframe);
  if (!words.empty() && words.back().word >= postings_by_word_.size()) {
    postings_by_word_.resize(words.back().word + std::size_t{1});
  }
  for (const WeightedWord& word : words) {
    postings_by_word_[word.word].push_back({keyframe, word.weight});
  }
  words_by_keyframe_.emplace(keyframe, std::move(words));
}

void PlaceDatabase::Remove(KeyframeId keyframe) {
  const auto found = words_by_keyframe_.find(keyframe);
  if (found == words_by_keyframe_.end()) return;
  for (const WeightedWord& word : found->second) {
    std::erase_if(postings_by_word_[word.word],
                  [&](const Posting& posting) { return posting.keyframe == keyframe; });
  }
  words_by_keyframe_.erase(found);
}

std::vector<SimilarPlace> PlaceDatabase::Query(const BagOfWords& words,
                                               const PlaceQuery& query) const {
  if (words_by_keyframe_.empty()) return {};
  // By id, which are few and dense. Every key frame's sum is taken in the order of the words, as
  // Similarity does it.
  std::vector<double> similarities(words_by_keyframe_.rbegin()->first.value + std::size_t{1}, 0);
  for (const WeightedWord& word : words) {
    if (word.word >= postings_by_word_.size()) break;
    for (const Posting& posting : postings_by_word_[word.word]) {
      similarities[posting.keyframe.value] += std::min(word.weight, posting.weight);
    }
  }
  std::vector<SimilarPlace> places;
  for (const auto& [keyframe, _] : words_by_keyframe_) {
    const double similarity = similarities[keyframe.value];
    if (similarity <= 0 || similarity < query.min_similarity) continue;
    if (!query.excluded.contains(keyframe)) places.push_back({keyframe, similarity});
  }
  std::ranges::stable_sort(places, std::greater<>(), &SimilarPlace::similarity);
  if (places.size() > query.max_count) places.resize(query.max_count);
  return places;
}

const BagOfWords* PlaceDatabase::Find(KeyframeId keyframe) const {
  const auto found = words_by_keyframe_.find(keyframe);
  return found == words_by_keyframe_.end() ? nullptr : &found->second;
}

}  // namespace ofm
