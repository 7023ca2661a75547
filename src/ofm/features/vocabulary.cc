#include "ofm/features/vocabulary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "ofm/base/check.h"
#include "ofm/features/hamming.h"

namespace ofm {

std::string FindFault(const VocabularyTree& tree) {
  const std::size_t nodes = tree.child_counts.size();
  if (nodes < 2) return "it has no word";
  if (tree.descriptors.size() != nodes) return "its nodes do not all have a descriptor";
  std::size_t next = 1, leaves = 0;
  for (std::size_t node = 0; node < nodes; ++node) {
    // Breadth first, a node is named as a child before its own children are.
    if (node >= next) return "its nodes do not make one tree";
    next += tree.child_counts[node];
    if (tree.child_counts[node] == 0) ++leaves;
  }
  if (next != nodes) return "its nodes do not make one tree";
  if (tree.idf.size() != leaves) return "its words do not all have a weight";
  const bool weighted =
      std::ranges::all_of(tree.idf, [](float idf) { return std::isfinite(idf) && idf >= 0; });
  return weighted ? "" : "a word's weight is no number or negative";
}

Vocabulary::Vocabulary(VocabularyTree tree) : tree_(std::move(tree)) {
  OFM_CHECK(FindFault(tree_).empty());
  std::uint32_t next = 1, word = 0;
  for (const std::uint8_t count : tree_.child_counts) {
    first_children_.push_back(count == 0 ? word++ : next);
    next += count;
    branching_ = std::max<int>(branching_, count);
  }
  std::vector<int> depths(first_children_.size(), 0);
  for (std::size_t node = 0; node < depths.size(); ++node) {
    for (int i = 0; i < tree_.child_counts[node]; ++i) {
      depths[first_children_[node] + i] = depths[node] + 1;
    }
  }
  depth_ = depths.back();  // breadth first: none is deeper
}

std::uint32_t Vocabulary::NearestChild(std::uint32_t node, const Descriptor& descriptor) const {
  std::array<std::uint16_t, 255> distances;
  const std::span<std::uint16_t> found(distances.data(), tree_.child_counts[node]);
  const std::uint32_t first = first_children_[node];
  HammingDistances(descriptor, {&tree_.descriptors[first], found.size()}, found);
  return first + static_cast<std::uint32_t>(std::ranges::min_element(found) - found.begin());
}

Vocabulary::Place Vocabulary::Descend(const Descriptor& descriptor, int index_depth) const {
  Place place{0, 0};
  std::uint32_t node = 0;
  for (int depth = 0; tree_.child_counts[node] > 0; ++depth) {
    node = NearestChild(node, descriptor);
    if (depth < index_depth) place.node = node;
  }
  place.word = first_children_[node];
  return place;
}

std::uint32_t Vocabulary::WordOf(const Descriptor& descriptor) const {
  return Descend(descriptor, 0).word;
}

PlaceDescription Vocabulary::Describe(std::span<const Descriptor> descriptors,
                                      int index_depth) const {
  OFM_CHECK(index_depth >= 0);
  PlaceDescription description;
  std::vector<WeightedWord> words;
  words.reserve(descriptors.size());
  description.nodes.reserve(descriptors.size());
  for (const Descriptor& descriptor : descriptors) {
    const Place place = Descend(descriptor, index_depth);
    words.push_back({place.word, tree_.idf[place.word]});
    description.nodes.push_back(place.node);
  }
  description.words = MakeBagOfWords(std::move(words));
  return description;
}

}  // namespace ofm
