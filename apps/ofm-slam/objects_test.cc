// The objects of a room, listed as a user does it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ofm/objects/object_database.h"
#include "ofm/objects/object_json.h"
#include "ofm/objects/test_inventory.h"
#include "test_recording.h"

namespace ofm {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A folder with the objects of a made room.
class ObjectsCommand : public testing::Test {
 protected:
  ObjectsCommand() { SaveObjects(folder_.path() / "objects.db", test::MadeInventory()); }

  ProgramResult List(const std::string& arguments = "") const {
    return RunProgram("objects '" + folder_.path().string() + "' " + arguments);
  }
  /// The ids of the objects listed, in their order.
  std::vector<int> Ids(const std::string& arguments) const {
    const ProgramResult result = List(arguments + " --json");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::vector<int> ids;
    const json listed = json::parse(result.out);
    for (const json& object : listed["objects"]) ids.push_back(object["id"]);
    return ids;
  }
  void ExpectError(const std::string& arguments, const char* reason) const {
    const ProgramResult result = List(arguments);
    EXPECT_EQ(result.exit_code, 1) << arguments;
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(result.err, AllOf(IsOneErrorLine(), HasSubstr(reason))) << arguments;
  }

  TestFolder folder_;
};

TEST_F(ObjectsCommand, PrintsATable) {
  const ProgramResult result = List();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("chair"), HasSubstr("5/16"), HasSubstr("0.60 x 0.40"),
                                HasSubstr("1 tracks"), Not(HasSubstr("away"))));
  EXPECT_THAT(List("--class person").out, HasSubstr("no such object"));
}

TEST_F(ObjectsCommand, FiltersAndSorts) {
  EXPECT_THAT(Ids("--class chair --near 3,0,2"), testing::ElementsAre(2, 0));
  EXPECT_THAT(Ids("--class chair book --near=2.1,0,2 --radius 1.05"), testing::ElementsAre(1, 2));
  EXPECT_THAT(Ids("--near=-1,0,0 --sort views --min-views 5"), testing::ElementsAre(2, 1));
  EXPECT_THAT(List("--near 1,0.25,1.875").out,
              AllOf(HasSubstr("away [m]"), HasSubstr("    0.00\n")));
}

TEST_F(ObjectsCommand, PrintsJsonAndTracks) {
  EXPECT_EQ(List("--json --tracks").out, ObjectsJson(test::MadeInventory()));
  EXPECT_THAT(List("--tracks").out, AllOf(HasSubstr("person"), HasSubstr("5.000000"),
                                          HasSubstr("0.62"), Not(HasSubstr("chair"))));
}

TEST_F(ObjectsCommand, BadInputIsOneErrorLine) {
  ExpectError("--class chiar", "there is no class 'chiar'; objects are of the classes book, chair");
  for (const char* place : {"1,2", "1,2,x", "1,2,3,4", "a", "1;2;3", "1,2,nan"}) {
    ExpectError(std::string("--near '") + place + "'", "is no place; write X,Y,Z in metres");
  }
  ExpectError("--radius 1", "--near");
  ExpectError("--sort distance", "--near");
  ExpectError("--sort colour", "--sort");
  const ProgramResult nowhere = RunProgram("objects /nowhere");
  EXPECT_THAT(nowhere.err, AllOf(IsOneErrorLine(), HasSubstr("/nowhere: does not exist")));
  folder_.Write("objects.db", "a text");
  ExpectError("", "objects.db: is no object database of ofm-slam");
  std::filesystem::remove(folder_.path() / "objects.db");
  ExpectError("", "ofm-slam run writes it where it is given a --segmenter");
}

TEST(ObjectsOfARun, AreWrittenWithASegmenterAndTheSameTwice) {
  const TestRecording recording(8);
  ASSERT_EQ(recording.Run("--segmenter none").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(recording.output() / "objects.db"));
  std::string database, text;
  for (int i = 0; i < 2; ++i) {
    const ProgramResult result =
        recording.Run("--segmenter masks --set perception.mask_class=chair");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("objects     "));
    const std::string database_now = ReadFile(recording.output() / "objects.db");
    const std::string text_now = ReadFile(recording.output() / "objects.json");
    if (i == 1) {
      EXPECT_TRUE(database_now == database);
      EXPECT_EQ(text_now, text);
    }
    database = database_now, text = text_now;
  }
  EXPECT_EQ(RunProgram("objects '" + recording.output().string() + "'").exit_code, 0);
}

}  // namespace
}  // namespace ofm
