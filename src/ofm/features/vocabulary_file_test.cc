#include "ofm/features/vocabulary_file.h"

#include <gmock/gmock.h>

#include "ofm/base/timing.h"
#include "ofm/features/test_vocabulary.h"
#include "ofm/io/read_file.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string ErrorOfDecoding(std::string_view bytes) {
  return ErrorOf([&] { DecodeVocabulary(bytes, "my.voc"); });
}

TEST(VocabularyFile, GivesBackWhatWasSaved) {
  const TestFolder folder;
  const Vocabulary vocabulary(RegularTree(9));
  SaveVocabulary(folder.path() / "my.voc", vocabulary);
  EXPECT_EQ(ReadFile(folder.path() / "my.voc"), EncodeVocabulary(vocabulary));
  // The root's descriptor means nothing, and is not stored.
  VocabularyTree wanted = vocabulary.tree();
  wanted.descriptors[0] = {};
  EXPECT_EQ(LoadVocabulary(folder.path() / "my.voc").tree(), wanted);
}

TEST(VocabularyFile, IsCompactAndLittleEndian) {
  const std::string bytes = EncodeVocabulary(Vocabulary(SmallTree()));
  EXPECT_EQ(bytes.size(), 8U + 12 + 5 + 4 * 32 + 3 * 4 + 8);
  EXPECT_EQ(bytes.substr(0, 25), std::string("OFMVOCAB\1\0\0\0\5\0\0\0\3\0\0\0\2\2\0\0\0", 25));
  const std::uint64_t first = SmallTree().descriptors[1][0];
  EXPECT_EQ(static_cast<unsigned char>(bytes[25]), first & 255);
  EXPECT_EQ(static_cast<unsigned char>(bytes[32]), first >> 56);
  EXPECT_EQ(bytes.substr(25 + 4 * 32, 4), std::string("\0\0\0\x3f", 4)) << "0.5F";
}

TEST(VocabularyFile, FlippedByteAnywhereIsAnErrorOfOneLineWithThePath) {
  const std::string good = EncodeVocabulary(Vocabulary(SmallTree()));
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bytes = good;
    bytes[i] = static_cast<char>(bytes[i] ^ 0x10);
    const std::string error = ErrorOfDecoding(bytes);
    EXPECT_THAT(error, testing::StartsWith("my.voc: ")) << i;
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
}

TEST(VocabularyFile, TruncatedFileIsAnErrorWhereverItEnds) {
  const std::string good = EncodeVocabulary(Vocabulary(SmallTree()));
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_THAT(ErrorOfDecoding(good.substr(0, size)),
                HasSubstr(size < 8 ? "is not a vocabulary" : "truncated"));
  }
  EXPECT_THAT(ErrorOfDecoding(good + "x"),
              HasSubstr("is damaged: it has 174 bytes instead of 173"));
}

TEST(VocabularyFile, SaysWhatIsWrong) {
  std::string bytes = EncodeVocabulary(Vocabulary(SmallTree()));
  EXPECT_THAT(ErrorOfDecoding("10 6 0 0\n"),
              AllOf(HasSubstr("is not a vocabulary"), HasSubstr("ofm-slam vocabulary train")));
  bytes[40] ^= 1;
  EXPECT_THAT(ErrorOfDecoding(bytes), HasSubstr("checksum"));
  bytes[8] = 2;
  EXPECT_THAT(ErrorOfDecoding(bytes), HasSubstr("format version 2, and this program reads 1"));
}

TEST(VocabularyFile, HugeCountsAreNoReasonToAllocate) {
  std::string bytes = EncodeVocabulary(Vocabulary(SmallTree()));
  for (std::size_t i = 12; i < 20; ++i) bytes[i] = '\xff';
  EXPECT_THAT(ErrorOfDecoding(bytes), HasSubstr("truncated"));
  for (std::size_t i = 12; i < 20; ++i) bytes[i] = 0;
  EXPECT_THAT(ErrorOfDecoding(bytes), HasSubstr("no nodes"));
}

TEST(VocabularyFile, MissingFileIsAnError) {
  EXPECT_THAT(ErrorOf([] { LoadVocabulary("/no/such.voc"); }),
              HasSubstr("/no/such.voc: does not exist"));
}

}  // namespace
}  // namespace ofm
