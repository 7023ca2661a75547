// Vocabularies as files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "ofm/features/vocabulary.h"

namespace ofm {

/// The vocabulary as it is stored, little-endian: "OFMVOCAB", version (u32), nodes (u32), words
/// (u32), children by node (u8 each), descriptors of all nodes but the root (32 bytes each),
/// weights of the words (float32 each), FNV-1a hash of all before (u64).
std::string EncodeVocabulary(const Vocabulary& vocabulary);

/// Inverse of EncodeVocabulary. Throws Error that names `path`, from where the bytes are: not a
/// vocabulary, another version, truncated, damaged.
Vocabulary DecodeVocabulary(std::string_view bytes, const std::filesystem::path& path);

/// Writes atomically (see atomic_file.h).
void SaveVocabulary(const std::filesystem::path& path, const Vocabulary& vocabulary);

/// Throws Error: cannot be read, or as DecodeVocabulary does.
Vocabulary LoadVocabulary(const std::filesystem::path& path);

}  // namespace ofm
