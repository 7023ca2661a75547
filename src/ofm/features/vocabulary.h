// A tree of visual words for binary descriptors.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ofm/features/bag_of_words.h"
#include "ofm/features/features.h"

namespace ofm {

/// What a vocabulary is made of. Nodes are numbered breadth first: 0 is the root, and the children
/// of a node are neighbours. The leaves, in the order of their nodes, are the words.
struct VocabularyTree {
  std::vector<std::uint8_t> child_counts;  ///< by node; 0 = a leaf
  std::vector<Descriptor> descriptors;     ///< by node; the root's means nothing
  std::vector<float> idf;  ///< by word: inverse document frequency, log(images / images with it)
  bool operator==(const VocabularyTree&) const = default;
};

/// What is wrong with a tree, in words; empty where it is sound.
std::string FindFault(const VocabularyTree& tree);

/// An image as a place: its words, and where each feature lies in the tree.
struct PlaceDescription {
  BagOfWords words;
  /// By feature: the node that it belongs to (the "direct index" of Galvez-Lopez and Tardos).
  /// Features of the same point mostly share it: see MatchByNode.
  std::vector<std::uint32_t> nodes;
};

/// A vocabulary tree (Nister and Stewenius, "Scalable recognition with a vocabulary tree", 2006) on
/// binary descriptors (Galvez-Lopez and Tardos, 2012). Immutable: threads may share it.
class Vocabulary {
 public:
  /// Levels below the root of the nodes in PlaceDescription: some 100 nodes of about 10 features.
  static constexpr int kIndexDepth = 2;

  /// Throws std::logic_error for a tree with a fault.
  explicit Vocabulary(VocabularyTree tree);

  /// Weights are term frequency times inverse document frequency. `index_depth` >= 0 chooses the
  /// level of the nodes; of a branch that ends before it, its leaf.
  PlaceDescription Describe(std::span<const Descriptor> descriptors,
                            int index_depth = kIndexDepth) const;

  /// The word nearest to `descriptor`, going down from the root: of equal children the first.
  std::uint32_t WordOf(const Descriptor& descriptor) const;

  std::uint32_t word_count() const { return static_cast<std::uint32_t>(tree_.idf.size()); }
  std::uint32_t node_count() const { return static_cast<std::uint32_t>(first_children_.size()); }
  /// Most children of a node.
  int branching() const { return branching_; }
  /// Levels below the root.
  int depth() const { return depth_; }
  const VocabularyTree& tree() const { return tree_; }

 private:
  struct Place {
    std::uint32_t word, node;
  };
  Place Descend(const Descriptor& descriptor, int index_depth) const;
  std::uint32_t NearestChild(std::uint32_t node, const Descriptor& descriptor) const;

  VocabularyTree tree_;
  std::vector<std::uint32_t> first_children_;  ///< by node; of a leaf, its word
  int branching_ = 0, depth_ = 0;
};

}  // namespace ofm
