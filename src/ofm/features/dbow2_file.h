// Vocabularies of DBoW2, as text.
#pragma once

#include <filesystem>

#include "ofm/features/vocabulary.h"

namespace ofm {

/// Reads a text vocabulary of 256-bit descriptors as of DBoW2 ("ORBvoc.txt"): "branching depth
/// scoring weighting" on the first line, then a node a line, "parent is_leaf 32_bytes weight".
/// Nodes are numbered by line from 1, and parents come first; 0 is the root. Scoring is read over,
/// as Similarity is always L1; weighting must be 0, tf-idf. Throws Error with path and line.
///
/// Descriptors compare the pixel pairs of their extractor. Words made of other pairs than those of
/// OrbExtractor's pattern, as in ORBvoc.txt, still divide our descriptors, but not as well.
Vocabulary LoadDbow2Vocabulary(const std::filesystem::path& path);

}  // namespace ofm
