#include "ofm/io/tum_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/base/error.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

constexpr const char* kRgb =
    "# color images\n"
    "1.000 rgb/1.000.png\n"
    "1.033 rgb/1.033.png\n"
    "1.066 rgb/1.066.png\n";
constexpr const char* kDepth =
    "1.010 depth/1.010.png\n"
    "1.070 depth/1.070.png\n";

std::string ErrorOfLists(const std::string& rgb, const std::string& depth) {
  const TestFolder folder;
  folder.Write("rgb.txt", rgb);
  folder.Write("depth.txt", depth);
  return ErrorOf([&] { ReadTumIndex(folder.path()); });
}

TEST(TumIndex, AssociatesTheLists) {
  const TestFolder folder;
  folder.Write("rgb.txt", kRgb);
  folder.Write("depth.txt", kDepth);
  const TumIndex index = ReadTumIndex(folder.path());
  ASSERT_EQ(index.entries.size(), 2u);
  const TumEntry& entry = index.entries[1];
  EXPECT_EQ(entry.color.stamp_ns, 1'066'000'000);
  EXPECT_EQ(entry.color.path, folder.path() / "rgb/1.066.png");
  EXPECT_EQ(entry.color.list, folder.path() / "rgb.txt");
  EXPECT_EQ(entry.color.line, 4);
  EXPECT_EQ(entry.depth.stamp_ns, 1'070'000'000);
  EXPECT_EQ(entry.depth.path, folder.path() / "depth/1.070.png");
  EXPECT_EQ(entry.depth.line, 2);
  EXPECT_FALSE(index.groundtruth);
}

TEST(TumIndex, TheLimitCanBeSet) {
  const TestFolder folder;
  folder.Write("rgb.txt", kRgb);
  folder.Write("depth.txt", kDepth);
  EXPECT_EQ(ReadTumIndex(folder.path(), 0.005).entries.size(), 1u);
}

TEST(TumIndex, AssociationsComeFirst) {
  const TestFolder folder;
  folder.Write("associations.txt", "1.033 rgb/1.033.png 1.5 depth/1.5.png\n");
  const TumIndex index = ReadTumIndex(folder.path());
  ASSERT_EQ(index.entries.size(), 1u);
  EXPECT_EQ(index.entries[0].color.path, folder.path() / "rgb/1.033.png");
  EXPECT_EQ(index.entries[0].depth.path, folder.path() / "depth/1.5.png");
  EXPECT_EQ(index.entries[0].depth.stamp_ns, 1'500'000'000);
  EXPECT_EQ(index.entries[0].depth.list, folder.path() / "associations.txt");
}

TEST(TumIndex, FindsTheGroundTruth) {
  const TestFolder folder;
  folder.Write("associations.txt", "1 a 1 b\n");
  const auto path = folder.Write("groundtruth.txt", "");
  EXPECT_EQ(ReadTumIndex(folder.path()).groundtruth, path);
}

TEST(TumIndex, NamesAMissingFolder) {
  EXPECT_EQ(ErrorOf([] { ReadTumIndex("/no/such"); }),
            "/no/such: does not exist; name a TUM RGB-D folder");
  const TestFolder folder;
  EXPECT_THAT(ErrorOf([&] { ReadTumIndex(folder.Write("file", "")); }),
              EndsWith("file: is no folder; name a TUM RGB-D folder"));
}

TEST(TumIndex, NamesAMissingList) {
  const TestFolder folder;
  EXPECT_THAT(ErrorOf([&] { ReadTumIndex(folder.path()); }), HasSubstr("rgb.txt: does not exist"));
  folder.Write("rgb.txt", kRgb);
  EXPECT_THAT(ErrorOf([&] { ReadTumIndex(folder.path()); }),
              HasSubstr("depth.txt: does not exist"));
}

TEST(TumIndex, NamesAnEmptyList) {
  EXPECT_THAT(ErrorOfLists("# nothing\n", kDepth), HasSubstr("rgb.txt: lists no image"));
  EXPECT_THAT(ErrorOfLists(kRgb, ""), HasSubstr("depth.txt: lists no image"));
  const TestFolder folder;
  folder.Write("associations.txt", "\n");
  EXPECT_THAT(ErrorOf([&] { ReadTumIndex(folder.path()); }),
              HasSubstr("associations.txt: lists no frame"));
}

TEST(TumIndex, NamesTheLineOfUnsortedTimes) {
  EXPECT_THAT(ErrorOfLists("2 a\n1 b\n", kDepth), HasSubstr("rgb.txt:2: time 1.000000 does not"));
  EXPECT_THAT(ErrorOfLists(kRgb, "#\n1 a\n1 b\n"), HasSubstr("depth.txt:3: time 1.000000 does"));
  const TestFolder folder;
  folder.Write("associations.txt", "2 a 2 b\n1 c 1 d\n");
  EXPECT_THAT(ErrorOf([&] { ReadTumIndex(folder.path()); }), HasSubstr("associations.txt:2: time"));
}

TEST(TumIndex, NamesTheLineOfBadFields) {
  EXPECT_THAT(ErrorOfLists("1 a\nnan b\n", kDepth), HasSubstr("rgb.txt:2: 'nan' is not a time"));
  EXPECT_THAT(ErrorOfLists("1\n", kDepth),
              EndsWith("rgb.txt:1: has 1 fields where 2 are needed: timestamp file"));
  const TestFolder folder;
  folder.Write("associations.txt", "1 a 1\n");
  EXPECT_THAT(ErrorOf([&] { ReadTumIndex(folder.path()); }),
              HasSubstr("associations.txt:1: has 3 fields where 4 are needed"));
}

TEST(TumIndex, ListsOfDifferentRecordingsAreAnError) {
  EXPECT_THAT(ErrorOfLists(kRgb, "9 a\n"), HasSubstr("within 0.02 s"));
}

TEST(TumIndex, FindsTheBenchmarksAssociations) {
  const std::filesystem::path desk = OFM_SHARED_DIR "/data/tum_fr1_desk";
  if (!std::filesystem::exists(desk)) GTEST_SKIP() << "needs " << desk;
  const TumIndex given = ReadTumIndex(desk);
  const TestFolder folder;
  std::filesystem::copy_file(desk / "rgb.txt", folder.path() / "rgb.txt");
  std::filesystem::copy_file(desk / "depth.txt", folder.path() / "depth.txt");
  const TumIndex ours = ReadTumIndex(folder.path());
  ASSERT_EQ(ours.entries.size(), 573u);
  ASSERT_EQ(given.entries.size(), ours.entries.size());
  for (std::size_t i = 0; i < ours.entries.size(); ++i) {
    EXPECT_EQ(ours.entries[i].color.stamp_ns, given.entries[i].color.stamp_ns);
    EXPECT_EQ(ours.entries[i].depth.stamp_ns, given.entries[i].depth.stamp_ns);
  }
}

}  // namespace
}  // namespace ofm
