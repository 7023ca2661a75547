#include "ofm/io/make_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

TEST(MakeFolder, MakesThoseAboveToo) {
  const TestFolder folder;
  MakeFolder(folder.path() / "a" / "b");
  EXPECT_TRUE(std::filesystem::is_directory(folder.path() / "a" / "b"));
  EXPECT_NO_THROW(MakeFolder(folder.path() / "a" / "b")) << "it is there";
}

TEST(MakeFolder, NamesTheOneThatCannotBeMade) {
  const TestFolder folder;
  const auto path = folder.Write("file", "in the way") / "below";
  EXPECT_THAT(ErrorOf([&] { MakeFolder(path); }),
              testing::HasSubstr(path.string() + ": cannot be made ("));
}

}  // namespace
}  // namespace ofm
