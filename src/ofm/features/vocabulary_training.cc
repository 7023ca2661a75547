#include "ofm/features/vocabulary_training.h"

#include <algorithm>
#include <cmath>

#include "ofm/base/error.h"
#include "ofm/features/descriptor_clusters.h"

namespace ofm {
namespace {

/// Grows the tree level by level. Descriptors are kept sorted by node.
class TreeBuilder {
 public:
  TreeBuilder(std::vector<Descriptor> descriptors, const VocabularyTrainingOptions& options,
              RandomEngine& engine)
      : options_(options), engine_(engine), descriptors_(std::move(descriptors)) {
    tree_.descriptors.emplace_back();
    level_ = {{0, descriptors_.size()}};
  }

  /// Splits the nodes of the lowest level. False where `watch` says stop.
  bool GrowLevel(int depth, const TrainingWatch& watch) {
    std::vector<Block> next;
    for (const Block& block : level_) {
      if (watch.stop.stop_requested()) return false;
      const std::size_t children = Split(block, next);
      tree_.child_counts.push_back(static_cast<std::uint8_t>(children));
      if (!watch.progress) continue;
      const double share_of_level =
          static_cast<double>(block.end) / static_cast<double>(descriptors_.size());
      watch.progress((depth + share_of_level) / options_.depth);
    }
    level_ = std::move(next);
    return true;
  }

  /// The tree with leaves for the lowest level, its words not yet weighted.
  VocabularyTree Finish() {
    tree_.child_counts.resize(tree_.descriptors.size(), 0);
    const auto leaves = std::ranges::count(tree_.child_counts, 0);
    tree_.idf.assign(static_cast<std::size_t>(leaves), 0);
    return std::move(tree_);
  }

 private:
  /// The descriptors of a node.
  struct Block {
    std::size_t begin = 0, end = 0;
  };

  /// Gives the node of `block` children, which are appended to the tree and to `next`; their
  /// number.
  std::size_t Split(const Block& block, std::vector<Block>& next) {
    const std::span<Descriptor> own(&descriptors_[block.begin], block.end - block.begin);
    if (own.size() < static_cast<std::size_t>(options_.min_split_descriptors)) return 0;
    const DescriptorClusters clusters =
        ClusterDescriptors(own, options_.branching, options_.max_iterations, engine_);
    if (clusters.centres.size() < 2) return 0;
    std::vector<std::vector<Descriptor>> members(clusters.centres.size());
    for (std::size_t i = 0; i < own.size(); ++i) members[clusters.cluster_of[i]].push_back(own[i]);
    auto out = own.begin();
    for (std::size_t k = 0; k < members.size(); ++k) {
      const std::size_t begin = block.begin + static_cast<std::size_t>(out - own.begin());
      out = std::ranges::copy(members[k], out).out;
      next.push_back({begin, begin + members[k].size()});
      tree_.descriptors.push_back(clusters.centres[k]);
    }
    return members.size();
  }

  const VocabularyTrainingOptions& options_;
  RandomEngine& engine_;
  std::vector<Descriptor> descriptors_;
  VocabularyTree tree_;
  std::vector<Block> level_;
};

/// log(images / images with the word); a word that none of them has counts as if one had it.
std::vector<float> InverseDocumentFrequencies(const Vocabulary& vocabulary,
                                              std::span<const std::vector<Descriptor>> images) {
  std::vector<std::uint32_t> images_with(vocabulary.word_count(), 0), last_seen_in(images_with);
  std::uint32_t image_number = 0;
  for (const std::vector<Descriptor>& image : images) {
    ++image_number;
    for (const Descriptor& descriptor : image) {
      const std::uint32_t word = vocabulary.WordOf(descriptor);
      if (last_seen_in[word] == image_number) continue;
      last_seen_in[word] = image_number;
      ++images_with[word];
    }
  }
  std::vector<float> idf;
  for (const std::uint32_t count : images_with) {
    idf.push_back(static_cast<float>(
        std::log(static_cast<double>(images.size()) / std::max<std::uint32_t>(count, 1))));
  }
  return idf;
}

}  // namespace

std::optional<Vocabulary> TrainVocabulary(std::span<const std::vector<Descriptor>> images,
                                          const VocabularyTrainingOptions& options,
                                          RandomEngine engine, const TrainingWatch& watch) {
  if (images.size() < 2) throw Error("a vocabulary is made of two images or more, better hundreds");
  std::vector<Descriptor> all;
  for (const std::vector<Descriptor>& image : images) {
    all.insert(all.end(), image.begin(), image.end());
  }
  if (all.empty()) throw Error("the images have no features; give others, or more of them");
  TreeBuilder builder(std::move(all), options, engine);
  for (int depth = 0; depth < options.depth; ++depth) {
    if (!builder.GrowLevel(depth, watch)) return std::nullopt;
  }
  VocabularyTree tree = builder.Finish();
  if (tree.idf.size() < 2) {
    throw Error("the images have too few different features for a vocabulary; give more of them");
  }
  tree.idf = InverseDocumentFrequencies(Vocabulary(tree), images);
  if (watch.progress) watch.progress(1);
  return Vocabulary(std::move(tree));
}

}  // namespace ofm
