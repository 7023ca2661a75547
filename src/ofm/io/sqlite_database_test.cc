#include "ofm/io/sqlite_database.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using testing::HasSubstr;

SqliteDatabase MakeDatabase() {
  SqliteDatabase database;
  database.Execute("CREATE TABLE things (id INTEGER PRIMARY KEY, size REAL, name TEXT, data BLOB)");
  SqliteStatement insert = database.Prepare("INSERT INTO things VALUES (?, ?, ?, ?)");
  const std::string bytes("\0\1\2", 3);
  insert.Run(std::int64_t{7}, 0.1, std::string("cup"), SqliteBlob{bytes});
  insert.Run(std::int64_t{1} << 60, -2.0, std::string(), SqliteBlob{});
  return database;
}

void ExpectThings(const SqliteDatabase& database) {
  SqliteStatement select = database.Prepare("SELECT id, size, name, data FROM things ORDER BY id");
  ASSERT_TRUE(select.Step());
  EXPECT_EQ(select.Integer(0), 7);
  EXPECT_EQ(select.Real(1), 0.1);
  EXPECT_EQ(select.Text(2), "cup");
  EXPECT_EQ(select.Blob(3), std::string_view("\0\1\2", 3));
  ASSERT_TRUE(select.Step());
  EXPECT_EQ(select.Integer(0), std::int64_t{1} << 60);
  EXPECT_EQ(select.Real(1), -2);
  EXPECT_EQ(select.Text(2), "");
  EXPECT_EQ(select.Blob(3).data(), nullptr);
  EXPECT_FALSE(select.Step());
  EXPECT_TRUE(select.Step()) << "it can be run again";
}

TEST(SqliteDatabase, GivesBackWhatItWasGiven) { ExpectThings(MakeDatabase()); }

TEST(SqliteDatabase, GoesThroughTheBytesOfAFile) {
  const std::string bytes = MakeDatabase().Serialize();
  EXPECT_EQ(bytes.substr(0, 15), "SQLite format 3");
  ExpectThings(SqliteDatabase(bytes));
}

TEST(SqliteDatabase, SameContentsGiveTheSameBytes) {
  EXPECT_EQ(MakeDatabase().Serialize(), MakeDatabase().Serialize());
}

TEST(SqliteDatabase, OneOfBytesCanBeChanged) {
  const std::string bytes = MakeDatabase().Serialize();
  SqliteDatabase database(bytes);
  database.Execute("DELETE FROM things WHERE id = 7");
  SqliteStatement count = database.Prepare("SELECT count(*) FROM things");
  ASSERT_TRUE(count.Step());
  EXPECT_EQ(count.Integer(0), 1);
  ExpectThings(SqliteDatabase(bytes));
}

TEST(SqliteDatabase, BytesOfSomethingElseAreAnError) {
  EXPECT_THAT(ErrorOf([] { SqliteDatabase database(std::string(4096, 'x')); }),
              HasSubstr("SQLite: file is not a database"));
  EXPECT_THAT(ErrorOf([] { SqliteDatabase database(std::string_view{}); }), HasSubstr("SQLite: "));
}

TEST(SqliteDatabase, WrongSqlIsAnError) {
  const SqliteDatabase database;
  EXPECT_THAT(ErrorOf([&] { database.Prepare("SELECT size FROM nowhere"); }),
              HasSubstr("SQLite: no such table: nowhere"));
}

TEST(SqliteDatabase, ABrokenRuleOfATableIsAnError) {
  SqliteDatabase database = MakeDatabase();
  EXPECT_THAT(ErrorOf([&] { database.Execute("INSERT INTO things (id) VALUES (7)"); }),
              HasSubstr("UNIQUE constraint failed: things.id"));
}

}  // namespace
}  // namespace ofm
