#include "ofm/features/dbow2_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "ofm/base/error.h"
#include "ofm/io/read_file.h"

namespace ofm {
namespace {

constexpr std::uint32_t kMaxNodes = 100'000'000;

/// A line of the file.
struct TextNode {
  std::uint32_t parent = 0;
  bool is_leaf = false;
  Descriptor descriptor{};
  float weight = 0;
};

/// Goes through a text line by line and number by number. ORBvoc.txt has 145 MB.
class LineReader {
 public:
  LineReader(const std::filesystem::path& path, std::string_view text) : path_(path), rest_(text) {}

  /// Goes to the next line that is not blank; false at the end.
  bool NextLine() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      line_ = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      SkipBlanks();
      if (!line_.empty()) return true;
    }
    return false;
  }

  /// The next number of the line, from `min` to `max`.
  template <class Number>
  Number Take(const char* what, Number min, Number max) {
    SkipBlanks();
    Number value{};
    const auto [end, error] = std::from_chars(line_.data(), line_.data() + line_.size(), value);
    const bool ends_well = end == line_.data() + line_.size() || IsBlank(*end);
    if (error != std::errc() || !ends_well || !(value >= min && value <= max)) {
      Fail(fmt::format("{} must be a number from {} to {}", what, min, max));
    }
    line_.remove_prefix(static_cast<std::size_t>(end - line_.data()));
    return value;
  }

  void RequireEnd() {
    SkipBlanks();
    if (!line_.empty()) Fail("has more than parent, leaf flag, 32 bytes and weight");
  }

  [[noreturn]] void Fail(const std::string& message) const { throw Error(path_, number_, message); }

 private:
  static bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  void SkipBlanks() {
    while (!line_.empty() && IsBlank(line_.front())) line_.remove_prefix(1);
  }

  const std::filesystem::path& path_;
  std::string_view rest_, line_;
  int number_ = 0;
};

void ReadHeader(LineReader& lines) {
  if (!lines.NextLine()) lines.Fail("is empty; a DBoW2 vocabulary begins with four numbers");
  lines.Take("branching", 2, 255);
  lines.Take("depth", 1, 32);
  lines.Take("scoring", 0, 5);
  if (lines.Take("weighting", 0, 3) != 0) {
    lines.Fail("weighting must be 0 (tf-idf): no other is supported");
  }
  lines.RequireEnd();
}

TextNode ReadNode(LineReader& lines, std::uint32_t number) {
  TextNode node;
  node.parent = lines.Take<std::uint32_t>("parent", 0, number - 1);
  node.is_leaf = lines.Take("leaf flag", 0, 1) == 1;
  for (std::size_t byte = 0; byte < sizeof(Descriptor); ++byte) {
    const auto value = lines.Take<std::uint32_t>("descriptor byte", 0, 255);
    node.descriptor[byte / 8] |= static_cast<std::uint64_t>(value) << (byte % 8 * 8);
  }
  node.weight = lines.Take<float>("weight", 0, std::numeric_limits<float>::max());
  lines.RequireEnd();
  return node;
}

/// The nodes by number; 0 is the root.
std::vector<TextNode> ReadNodes(LineReader& lines) {
  std::vector<TextNode> nodes(1);
  std::vector<std::uint8_t> child_counts(1, 0);
  while (lines.NextLine()) {
    const auto number = static_cast<std::uint32_t>(nodes.size());
    if (number == kMaxNodes) lines.Fail("has too many nodes");
    nodes.push_back(ReadNode(lines, number));
    child_counts.push_back(0);
    const std::uint32_t parent = nodes.back().parent;
    if (nodes[parent].is_leaf) lines.Fail(fmt::format("its parent, node {}, is a leaf", parent));
    if (++child_counts[parent] == 0)
      lines.Fail(fmt::format("node {} has over 255 children", parent));
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (child_counts[i] > 0 || nodes[i].is_leaf) continue;
    lines.Fail(i == 0 ? "has no nodes"
                      : fmt::format("node {} has no children, but is no leaf; is "
                                    "the file complete?",
                                    i));
  }
  return nodes;
}

/// Renumbers breadth first, children in the order of the file.
VocabularyTree BreadthFirst(const std::vector<TextNode>& nodes) {
  std::vector<std::vector<std::uint32_t>> children(nodes.size());
  for (std::uint32_t i = 1; i < nodes.size(); ++i) children[nodes[i].parent].push_back(i);
  VocabularyTree tree;
  std::vector<std::uint32_t> order = {0};
  for (std::size_t i = 0; i < order.size(); ++i) {
    const TextNode& node = nodes[order[i]];
    const std::vector<std::uint32_t>& own = children[order[i]];
    tree.child_counts.push_back(static_cast<std::uint8_t>(own.size()));
    tree.descriptors.push_back(node.descriptor);
    if (own.empty()) tree.idf.push_back(node.weight);
    order.insert(order.end(), own.begin(), own.end());
  }
  return tree;
}

}  // namespace

Vocabulary LoadDbow2Vocabulary(const std::filesystem::path& path) {
  const std::string text = ReadFile(path);
  LineReader lines(path, text);
  ReadHeader(lines);
  return Vocabulary(BreadthFirst(ReadNodes(lines)));
}

}  // namespace ofm
