#include "ofm/features/dbow2_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "ofm/features/test_vocabulary.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// "parent leaf bytes weight" with every byte the same.
std::string Node(int parent, int leaf, int byte, const char* weight) {
  std::string line = fmt::format("{} {} ", parent, leaf);
  for (int i = 0; i < 32; ++i) line += fmt::format("{} ", byte);
  return line + weight + "\n";
}

Descriptor Filled(std::uint64_t byte) {
  Descriptor descriptor;
  descriptor.fill(byte * 0x0101010101010101U);
  return descriptor;
}

class Dbow2File : public testing::Test {
 protected:
  Vocabulary Load(const std::string& text) const {
    return LoadDbow2Vocabulary(folder_.Write("voc.txt", text));
  }
  std::string Error(const std::string& text) const {
    return ErrorOf([&] { Load(text); });
  }

  /// Depth first, as DBoW2 may write it: node 1 has the leaves 2 and 3, node 4 is a leaf.
  const std::string good_ = "10 6 0 0\n" + Node(0, 0, 1, "0") + Node(1, 1, 2, "0.25") +
                            Node(1, 1, 3, "1.5e0") + Node(0, 1, 255, "3");
  TestFolder folder_;
};

TEST_F(Dbow2File, IsReadInBreadthFirstOrder) {
  const VocabularyTree tree = Load(good_).tree();
  EXPECT_EQ(tree.child_counts, (std::vector<std::uint8_t>{2, 2, 0, 0, 0}));
  EXPECT_EQ(tree.descriptors,
            (std::vector<Descriptor>{{}, Filled(1), Filled(255), Filled(2), Filled(3)}));
  EXPECT_EQ(tree.idf, (std::vector<float>{3, 0.25F, 1.5F}));
}

TEST_F(Dbow2File, BytesFillTheDescriptorFromItsLowestBits) {
  std::string bytes;
  for (int i = 0; i < 32; ++i) bytes += fmt::format("{} ", i);
  const VocabularyTree tree = Load("10 6 0 0\n0 1 " + bytes + "1\n").tree();
  EXPECT_EQ(tree.descriptors[1][0], 0x0706050403020100U);
  EXPECT_EQ(tree.descriptors[1][3], 0x1f1e1d1c1b1a1918U);
}

TEST_F(Dbow2File, BlankLinesAndLineEndsOfDosDoNotCount) {
  std::string dos;
  for (const char c : good_) dos += c == '\n' ? std::string(" \r\n") : std::string(1, c);
  EXPECT_EQ(Load(dos + "\r\n\n").tree(), Load(good_).tree());
}

TEST_F(Dbow2File, ErrorsNameTheLine) {
  EXPECT_THAT(Error("10 6 0 0\n" + Node(0, 0, 1, "0") + Node(2, 1, 2, "1")),
              AllOf(HasSubstr("voc.txt:3: parent must be a number from 0 to 1")));
  EXPECT_THAT(Error("10 6 0 0\n" + Node(0, 1, 256, "0")),
              HasSubstr("voc.txt:2: descriptor byte must be a number from 0 to 255"));
  EXPECT_THAT(Error("10 6 0 0\n" + Node(0, 2, 1, "0")), HasSubstr(":2: leaf flag must be"));
  EXPECT_THAT(Error("10 6 0 0\n" + Node(0, 1, 1, "-1")), HasSubstr(":2: weight must be"));
  EXPECT_THAT(Error("10 6 0 0\n" + Node(0, 1, 1, "nan")), HasSubstr(":2: weight must be"));
  EXPECT_THAT(Error("10 6 0 0\n" + Node(0, 1, 1, "1x")), HasSubstr(":2: weight must be"));
  EXPECT_THAT(Error("10 6 0 0\n" + Node(0, 1, 1, "1 2")), HasSubstr(":2: has more than"));
  EXPECT_THAT(Error("10 6 0 0\n" + Node(0, 1, 1, "1") + Node(1, 1, 1, "1")),
              HasSubstr(":3: its parent, node 1, is a leaf"));
}

TEST_F(Dbow2File, HeaderMustBeOfASupportedVocabulary) {
  EXPECT_THAT(Error("10 6 0 1\n" + Node(0, 1, 1, "1")), HasSubstr(":1: weighting must be 0"));
  EXPECT_THAT(Error("OFMVOCAB"), HasSubstr(":1: branching must be a number from 2 to 255"));
  EXPECT_THAT(Error("10 6 0\n"), HasSubstr(":1: weighting must be a number"));
  EXPECT_THAT(Error(""), HasSubstr("is empty"));
  EXPECT_THAT(Error("10 6 0 0\n"), HasSubstr("has no nodes"));
}

TEST_F(Dbow2File, CutOffFileIsAnError) {
  EXPECT_THAT(Error("10 6 0 0\n" + Node(0, 0, 1, "0")),
              HasSubstr("node 1 has no children, but is no leaf; is the file complete?"));
  EXPECT_THAT(Error("10 6 0 0\n0 1 1 2 3"), HasSubstr(":2: descriptor byte"));
}

TEST_F(Dbow2File, TooManyChildrenAreAnError) {
  std::string text = "10 6 0 0\n";
  for (int i = 0; i < 255; ++i) text += Node(0, 1, i, "1");
  EXPECT_EQ(Load(text).branching(), 255);
  EXPECT_THAT(Error(text + Node(0, 1, 1, "1")), HasSubstr(":257: node 0 has over 255 children"));
}

}  // namespace
}  // namespace ofm
