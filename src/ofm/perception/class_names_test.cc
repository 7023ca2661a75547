#include "ofm/perception/class_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/io/test_folder.h"
#include "ofm/perception/test_support.h"

namespace ofm {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string LoadError(std::string_view text) {
  const TestFolder folder;
  const auto path = folder.Write("names.txt", text);
  return ErrorOf([&] { LoadClassNames(path); });
}

TEST(ClassNames, CocoHasEightyWithThePersonFirst) {
  EXPECT_EQ(CocoClassNames().size(), 80U);
  EXPECT_EQ(FindClass(CocoClassNames(), "person"), ClassId(0));
  EXPECT_EQ(FindClass(CocoClassNames(), "toothbrush"), ClassId(79));
}

TEST(ClassNames, CocoIsTheListThatComesWithTheModels) {
  const std::filesystem::path path = std::filesystem::path(OFM_SHARED_DIR) / "models/coco80.txt";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
  EXPECT_EQ(LoadClassNames(path), CocoClassNames());
}

TEST(ClassNames, UnknownNameHasNoClass) {
  EXPECT_FALSE(FindClass(CocoClassNames(), "Person").valid());
  EXPECT_FALSE(FindClass({}, "person").valid());
}

TEST(ClassNames, FileHasOneNameALineWhateverTheLineEnds) {
  const TestFolder folder;
  EXPECT_THAT(LoadClassNames(folder.Write("names.txt", "cup\r\ncoffee table \nrobot\n\n")),
              ElementsAre("cup", "coffee table", "robot"));
}

TEST(ClassNames, BadFilesAreNamedWithTheLine) {
  EXPECT_THAT(LoadError(""), AllOf(HasSubstr("names.txt"), HasSubstr("no class name")));
  EXPECT_THAT(LoadError("a\n\nb\n"), HasSubstr("names.txt:2: empty class name"));
  EXPECT_THAT(LoadError("a\nb\na\n"), HasSubstr("names.txt:3: class 'a' is listed twice"));
  EXPECT_THAT(ErrorOf([] { LoadClassNames("/no/such/names.txt"); }),
              HasSubstr("/no/such/names.txt: cannot read"));
}

TEST(ClassNames, MoreThanLabelImagesCanHoldIsAnError) {
  std::string names;
  for (int i = 0; i < 255; ++i) names += "class" + std::to_string(i) + "\n";
  EXPECT_EQ(LoadError(names), "");
  EXPECT_THAT(LoadError(names + "one more\n"), HasSubstr("has 256 class names; 255 are allowed"));
}

}  // namespace
}  // namespace ofm
