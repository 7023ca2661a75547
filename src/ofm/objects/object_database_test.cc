#include "ofm/objects/object_database.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/base/error.h"
#include "ofm/io/read_file.h"
#include "ofm/io/sqlite_database.h"
#include "ofm/io/test_folder.h"
#include "ofm/objects/object_json.h"
#include "ofm/objects/test_inventory.h"

namespace ofm {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ObjectDatabase : public testing::Test {
 protected:
  std::string ErrorOfLoading() const {
    try {
      LoadObjects(path_);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
  /// Runs SQL on the file.
  void Change(const std::string& sql) const {
    SqliteDatabase database(ReadFile(path_));
    database.Execute(sql);
    folder_.Write("objects.db", database.Serialize());
  }

  TestFolder folder_;
  std::filesystem::path path_ = folder_.path() / "objects.db";
};

TEST_F(ObjectDatabase, GivesBackWhatWasSavedToTheBit) {
  const ObjectInventory saved = test::MadeInventory();
  SaveObjects(path_, saved);
  const ObjectInventory loaded = LoadObjects(path_);
  EXPECT_EQ(loaded.class_names, saved.class_names);
  EXPECT_EQ(loaded.up_in_world, saved.up_in_world);
  ASSERT_EQ(loaded.objects.size(), saved.objects.size());
  for (std::size_t i = 0; i < saved.objects.size(); ++i) {
    const SceneObject &a = loaded.objects[i], &b = saved.objects[i];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.classes, b.classes);
    EXPECT_EQ(a.box.center_in_world, b.box.center_in_world);
    EXPECT_EQ(a.box.world_from_box.coeffs(), b.box.world_from_box.coeffs());
    EXPECT_EQ(a.box.size_m, b.box.size_m);
    EXPECT_EQ(a.centroid_in_world, b.centroid_in_world);
    EXPECT_EQ(a.first_seen_ns, b.first_seen_ns);
    EXPECT_EQ(a.last_seen_ns, b.last_seen_ns);
    EXPECT_EQ(a.views, b.views);
    EXPECT_EQ(a.views_expected, b.views_expected);
    EXPECT_EQ(a.confidence, b.confidence);
    EXPECT_EQ(a.point_count, b.point_count);
    EXPECT_EQ(a.color, b.color);
  }
  EXPECT_EQ(ObjectsJson(loaded), ObjectsJson(saved)) << "tracks, too";
}

TEST_F(ObjectDatabase, HasTheSameBytesTwice) {
  SaveObjects(path_, test::MadeInventory());
  const std::string first = ReadFile(path_);
  SaveObjects(path_, test::MadeInventory());
  EXPECT_TRUE(ReadFile(path_) == first);
  EXPECT_EQ(folder_.CountEntries(), 1U);
}

TEST_F(ObjectDatabase, CanBeAskedInSql) {
  SaveObjects(path_, test::MadeInventory());
  const SqliteDatabase database(ReadFile(path_));
  SqliteStatement row =
      database.Prepare("SELECT count(*), max(x) FROM named_objects WHERE class = 'chair'");
  ASSERT_TRUE(row.Step());
  EXPECT_EQ(row.Integer(0), 2);
  EXPECT_EQ(row.Real(1), 3);
}

TEST_F(ObjectDatabase, OfAnEmptyRoomIsReadBack) {
  SaveObjects(path_, {});
  EXPECT_TRUE(LoadObjects(path_).objects.empty());
}

TEST_F(ObjectDatabase, SaysWhatIsWrongWithAFile) {
  EXPECT_THAT(ErrorOfLoading(), HasSubstr("objects.db: does not exist"));
  folder_.Write("objects.db", "a text");
  EXPECT_THAT(ErrorOfLoading(), HasSubstr("objects.db: is no object database of ofm-slam: "));
  folder_.Write("objects.db", "");
  EXPECT_THAT(ErrorOfLoading(), HasSubstr("objects.db: is no object database of ofm-slam: "));
  SaveObjects(path_, test::MadeInventory());
  const std::string bytes = ReadFile(path_);
  for (const auto& [sql, reason] : std::vector<std::pair<const char*, const char*>>{
           {"PRAGMA user_version = 9", "it is of version 9, and this program reads version 1"},
           {"PRAGMA application_id = 1", "another program's"},
           {"DELETE FROM scene", "the table scene is empty"},
           {"DELETE FROM classes WHERE id = 0", "a class is missing"},
           {"UPDATE objects SET id = 9 WHERE id = 0", "an object has no class"},
           {"UPDATE tracks SET class_id = 99", "a class has no name"},
           {"DROP TABLE track_points", "no such table"}}) {
    folder_.Write("objects.db", bytes);
    Change(sql);
    EXPECT_THAT(ErrorOfLoading(), AllOf(HasSubstr("objects.db"), HasSubstr(reason))) << sql;
  }
}

}  // namespace
}  // namespace ofm
