#include "ofm/features/vocabulary_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "ofm/base/error.h"
#include "ofm/io/atomic_file.h"
#include "ofm/io/read_file.h"

namespace ofm {
namespace {

constexpr std::string_view kMagic = "OFMVOCAB";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderBytes = kMagic.size() + 3 * sizeof(std::uint32_t);
constexpr std::size_t kHashBytes = sizeof(std::uint64_t);

/// FNV-1a (Fowler, Noll, Vo). A single changed byte always changes it.
std::uint64_t HashOf(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
  }
  return hash;
}

template <class Unsigned>
void Append(std::string& bytes, Unsigned value) {
  for (std::size_t i = 0; i < sizeof value; ++i) {
    bytes.push_back(static_cast<char>((value >> (8 * i)) & 255));
  }
}

/// Takes numbers from the front of `bytes`, which are long enough.
template <class Unsigned>
Unsigned Take(std::string_view& bytes) {
  Unsigned value = 0;
  for (std::size_t i = 0; i < sizeof value; ++i) {
    value |= static_cast<Unsigned>(static_cast<Unsigned>(static_cast<unsigned char>(bytes[i]))
                                   << (8 * i));
  }
  bytes.remove_prefix(sizeof value);
  return value;
}

std::uint64_t FileSize(std::uint64_t nodes, std::uint64_t words) {
  return kHeaderBytes + nodes + sizeof(Descriptor) * (nodes - 1) + sizeof(float) * words +
         kHashBytes;
}

struct Header {
  std::uint32_t version, nodes, words;
};

/// Takes the header from `rest` and checks it against the length of the file.
Header TakeHeader(std::string_view& rest, const std::filesystem::path& path) {
  const std::uint64_t size = rest.size();
  if (!rest.starts_with(kMagic)) {
    throw Error(path, "is not a vocabulary; make one with ofm-slam vocabulary train or import");
  }
  if (size < kHeaderBytes) throw Error(path, "is truncated; make it again");
  rest.remove_prefix(kMagic.size());
  Header header{};
  header.version = Take<std::uint32_t>(rest);
  header.nodes = Take<std::uint32_t>(rest);
  header.words = Take<std::uint32_t>(rest);
  if (header.version != kVersion) {
    throw Error(path, fmt::format("has format version {}, and this program reads {}; make it again "
                                  "with ofm-slam vocabulary train or import",
                                  header.version, kVersion));
  }
  if (header.nodes == 0) throw Error(path, "is damaged: it has no nodes; make it again");
  const std::uint64_t wanted = FileSize(header.nodes, header.words);
  if (size != wanted) {
    throw Error(path, fmt::format("is {}: it has {} bytes instead of {}; make it again",
                                  size < wanted ? "truncated" : "damaged", size, wanted));
  }
  return header;
}

VocabularyTree TakeTree(std::string_view& rest, const Header& header) {
  VocabularyTree tree;
  tree.child_counts.resize(header.nodes);
  for (std::uint8_t& count : tree.child_counts) count = Take<std::uint8_t>(rest);
  tree.descriptors.resize(header.nodes);
  for (std::size_t node = 1; node < header.nodes; ++node) {
    for (std::uint64_t& word : tree.descriptors[node]) word = Take<std::uint64_t>(rest);
  }
  tree.idf.resize(header.words);
  for (float& idf : tree.idf) idf = std::bit_cast<float>(Take<std::uint32_t>(rest));
  return tree;
}

}  // namespace

std::string EncodeVocabulary(const Vocabulary& vocabulary) {
  const VocabularyTree& tree = vocabulary.tree();
  std::string bytes(kMagic);
  bytes.reserve(FileSize(vocabulary.node_count(), vocabulary.word_count()));
  Append(bytes, kVersion);
  Append(bytes, vocabulary.node_count());
  Append(bytes, vocabulary.word_count());
  for (const std::uint8_t count : tree.child_counts) Append(bytes, count);
  for (std::size_t node = 1; node < tree.descriptors.size(); ++node) {
    for (const std::uint64_t word : tree.descriptors[node]) Append(bytes, word);
  }
  for (const float idf : tree.idf) Append(bytes, std::bit_cast<std::uint32_t>(idf));
  Append(bytes, HashOf(bytes));
  return bytes;
}

Vocabulary DecodeVocabulary(std::string_view bytes, const std::filesystem::path& path) {
  std::string_view rest = bytes;
  const Header header = TakeHeader(rest, path);
  VocabularyTree tree = TakeTree(rest, header);
  if (Take<std::uint64_t>(rest) != HashOf(bytes.substr(0, bytes.size() - kHashBytes))) {
    throw Error(path, "is damaged: its checksum does not match; make it again");
  }
  const std::string fault = FindFault(tree);
  if (!fault.empty()) throw Error(path, "is damaged: " + fault + "; make it again");
  return Vocabulary(std::move(tree));
}

void SaveVocabulary(const std::filesystem::path& path, const Vocabulary& vocabulary) {
  WriteFileAtomically(path, EncodeVocabulary(vocabulary));
}

Vocabulary LoadVocabulary(const std::filesystem::path& path) {
  return DecodeVocabulary(ReadFile(path), path);
}

}  // namespace ofm
