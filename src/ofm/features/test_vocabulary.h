// A small vocabulary whose words are known. Tests only.
#pragma once

#include "ofm/features/test_descriptors.h"
#include "ofm/features/vocabulary.h"

namespace ofm {

/// Root (0) with two nodes (1, 2); node 1 has the words 1 and 2 (nodes 3, 4), node 2 is word 0
/// itself. Named by their descriptors: RandomDescriptors(5, 11).
inline VocabularyTree SmallTree() {
  return {{2, 2, 0, 0, 0}, RandomDescriptors(5, 11), {0.5F, 1, 2}};
}

/// Two levels of `branching` children; the words' weights differ.
inline VocabularyTree RegularTree(int branching) {
  const int nodes = 1 + branching + branching * branching;
  VocabularyTree tree;
  tree.descriptors = RandomDescriptors(nodes, 12);
  tree.child_counts.assign(static_cast<std::size_t>(nodes), 0);
  for (int i = 0; i <= branching; ++i) tree.child_counts[i] = static_cast<std::uint8_t>(branching);
  for (int i = 0; i < branching * branching; ++i) tree.idf.push_back(1.0F + 0.01F * i);
  return tree;
}

}  // namespace ofm
