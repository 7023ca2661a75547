#include "ofm/io/table_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/base/error.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::IsEmpty;

TEST(TableFile, SplitsRowsAndSkipsComments) {
  const TestFolder folder;
  const TableFile file(folder.Write("t.txt", "# a b\n1 two\n\n  \t\r\n 3,\tfour \r\n5"));
  ASSERT_EQ(file.rows().size(), 3u);
  EXPECT_EQ(file.rows()[0].line, 2);
  EXPECT_THAT(file.rows()[0].fields, ElementsAre("1", "two"));
  EXPECT_EQ(file.rows()[1].line, 5);
  EXPECT_THAT(file.rows()[1].fields, ElementsAre("3", "four"));
  EXPECT_EQ(file.rows()[2].line, 6);
  EXPECT_THAT(file.rows()[2].fields, ElementsAre("5"));
}

TEST(TableFile, HasNoRowsWhereThereIsNothing) {
  const TestFolder folder;
  EXPECT_THAT(TableFile(folder.Write("a", "")).rows(), IsEmpty());
  EXPECT_THAT(TableFile(folder.Write("b", "\n#\n")).rows(), IsEmpty());
}

TEST(TableFile, NumbersAreFiniteOrAnErrorThatNamesTheLine) {
  const TestFolder folder;
  const auto path = folder.Write("t.txt", "#\n-1.5e-3 nan inf 1.5x 1,5 " + std::string(60, 'a'));
  const TableFile file(path);
  const auto& row = file.rows()[0];
  EXPECT_EQ(file.Number(row, 0), -1.5e-3);
  EXPECT_EQ(ErrorOf([&] { file.Number(row, 1); }),
            path.string() + ":2: 'nan' is not a finite number");
  EXPECT_NE(ErrorOf([&] { file.Number(row, 2); }), "");
  EXPECT_NE(ErrorOf([&] { file.Number(row, 3); }), "");
  EXPECT_THAT(ErrorOf([&] { file.Number(row, 6); }), EndsWith("aaa...' is not a finite number"));
}

TEST(TableFile, StampsAreExactNanoseconds) {
  const TestFolder folder;
  const TableFile file(
      folder.Write("t.txt", "1305031453.359684 -0.5 1.305031453e+09 nan 1e300 12:30"));
  const auto& row = file.rows()[0];
  EXPECT_EQ(file.Stamp(row, 0), 1305031453359684000);
  EXPECT_EQ(file.Stamp(row, 1), -500000000);
  EXPECT_EQ(file.Stamp(row, 2), 1305031453000000000);
  for (const std::size_t field : {3, 4, 5}) {
    EXPECT_THAT(ErrorOf([&] { file.Stamp(row, field); }), EndsWith("is not a time in seconds"));
  }
}

TEST(TableFile, CountsColumns) {
  const TestFolder folder;
  const TableFile file(folder.Write("t.txt", "1 2\n1 2 3"));
  EXPECT_NO_THROW(file.RequireColumns(file.rows()[0], "time file"));
  EXPECT_THAT(ErrorOf([&] { file.RequireColumns(file.rows()[1], "time file"); }),
              EndsWith("t.txt:2: has 3 fields where 2 are needed: time file"));
}

TEST(TableFile, MessagesHoldNoControlCharacters) {
  const TestFolder folder;
  const TableFile file(folder.Write("t.txt", "a\x01\xff"));
  EXPECT_THAT(ErrorOf([&] { file.Number(file.rows()[0], 0); }),
              EndsWith(":1: 'a..' is not a finite number"));
}

TEST(StampOrder, WantsIncreasingTimes) {
  const TestFolder folder;
  const TableFile file(folder.Write("t.txt", "a\nb\nc\nd"));
  StampOrder order;
  order.Require(file, file.rows()[0], -7'000'000'000);
  order.Require(file, file.rows()[1], 1'500'000'000);
  EXPECT_THAT(ErrorOf([&] { order.Require(file, file.rows()[2], 1'500'000'000); }),
              EndsWith("t.txt:3: time 1.500000 does not come after 1.500000 of line 2; sort by "
                       "time and remove duplicates"));
  EXPECT_NE(ErrorOf([&] { order.Require(file, file.rows()[3], 0); }), "");
}

}  // namespace
}  // namespace ofm
