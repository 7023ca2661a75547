// Finds the key frames that show the same place as an image.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "ofm/base/ids.h"
#include "ofm/features/bag_of_words.h"

namespace ofm {

/// A key frame and its Similarity to what was asked for.
struct SimilarPlace {
  KeyframeId keyframe;
  double similarity = 0;
  bool operator==(const SimilarPlace&) const = default;
};

/// What PlaceDatabase::Query shall find.
struct PlaceQuery {
  double min_similarity = 0;  ///< key frames without a common word are never found
  std::size_t max_count = std::numeric_limits<std::size_t>::max();
  std::set<KeyframeId> excluded = {};  ///< not to be found: neighbours of the one that asks
};

/// Key frames by the words that they show (an inverted file): a query looks at those alone that
/// share a word. A value: copies are independent. One writer at a time; const members may be called
/// from several threads. All words are of one vocabulary.
class PlaceDatabase {
 public:
  /// Replaces what was known of `keyframe`.
  void Add(KeyframeId keyframe, BagOfWords words);
  /// Forgets it; nothing happens where it is not known.
  void Remove(KeyframeId keyframe);

  /// The most similar first, of equals the one with the smaller id.
  std::vector<SimilarPlace> Query(const BagOfWords& words, const PlaceQuery& query = {}) const;

  /// The words of a key frame; null where it is not known.
  const BagOfWords* Find(KeyframeId keyframe) const;
  std::size_t size() const { return words_by_keyframe_.size(); }

 private:
  struct Posting {
    KeyframeId keyframe;
    float weight;
  };

  std::map<KeyframeId, BagOfWords> words_by_keyframe_;
  std::vector<std::vector<Posting>> postings_by_word_;
};

}  // namespace ofm
