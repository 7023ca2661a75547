#include "ofm/base/error.h"

#include <gtest/gtest.h>

namespace ofm {
namespace {

TEST(Error, SaysAMessageAlone) {
  const Error error("no frames");
  EXPECT_STREQ(error.what(), "no frames");
  EXPECT_TRUE(error.path().empty());
  EXPECT_FALSE(error.line().has_value());
}

TEST(Error, PutsThePathFirst) {
  const Error error("data/rgb.txt", "cannot be opened");
  EXPECT_STREQ(error.what(), "data/rgb.txt: cannot be opened");
  EXPECT_EQ(error.path(), "data/rgb.txt");
  EXPECT_FALSE(error.line().has_value());
}

TEST(Error, NamesPathAndLineAsCompilersDo) {
  const Error error("data/rgb.txt", 12, "has no file name");
  EXPECT_STREQ(error.what(), "data/rgb.txt:12: has no file name");
  EXPECT_EQ(error.line(), 12);
}

TEST(Error, IsNoProgrammersError) {
  static_assert(std::is_base_of_v<std::runtime_error, Error>);
  static_assert(!std::is_base_of_v<std::logic_error, Error>);
}

}  // namespace
}  // namespace ofm
