#include "ofm/io/sha256.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

// The example of FIPS 180-4.
constexpr const char* kOfAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

TEST(Sha256, OfTheStandardsExample) {
  Sha256 hash;
  hash.Add(std::string_view("a"));
  hash.Add(std::string_view("bc"));
  EXPECT_EQ(hash.Finish(), kOfAbc);
}

TEST(Sha256, OfAFile) {
  const TestFolder folder;
  EXPECT_EQ(Sha256OfFile(folder.Write("abc", "abc")), kOfAbc);
  EXPECT_THAT(ErrorOf([&] { Sha256OfFile(folder.path() / "none"); }),
              testing::HasSubstr("none: does not exist"));
}

TEST(Sha256, IsReadInEitherCaseAndNothingElse) {
  std::string upper = kOfAbc;
  for (char& c : upper) c = static_cast<char>(std::toupper(c));
  EXPECT_EQ(ParseSha256(upper), kOfAbc);
  EXPECT_THAT(ErrorOf([] { ParseSha256("ba78"); }), testing::HasSubstr("'ba78' is no SHA-256"));
}

}  // namespace
}  // namespace ofm
