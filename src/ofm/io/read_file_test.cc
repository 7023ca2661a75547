#include "ofm/io/read_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/base/error.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

TEST(ReadFile, GivesEveryByte) {
  const TestFolder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  EXPECT_EQ(ReadFile(folder.Write("f", bytes)), bytes);
  EXPECT_EQ(ReadFile(folder.Write("empty", "")), "");
  const std::string large(300'000, 'x');
  EXPECT_EQ(ReadFile(folder.Write("large", large)), large);
}

TEST(ReadFile, NamesTheFileThatIsMissing) {
  const TestFolder folder;
  EXPECT_EQ(ErrorOf([&] { ReadFile(folder.path() / "none.txt"); }),
            (folder.path() / "none.txt").string() + ": does not exist; check the path");
}

TEST(ReadFile, RefusesAFolder) {
  const TestFolder folder;
  EXPECT_THAT(ErrorOf([&] { ReadFile(folder.path()); }), testing::HasSubstr("is a folder"));
}

}  // namespace
}  // namespace ofm
