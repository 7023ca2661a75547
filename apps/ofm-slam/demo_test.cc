#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "test_recording.h"

namespace ofm {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Demo, RunsTheSameRecordingWithAndWithoutCulling) {
  const TestFolder folder;
  const std::filesystem::path output = folder.path() / "demo";
  const ProgramResult result =
      RunProgram("demo --quiet --frames 8 --seed 2 --output " + output.string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(result.out, AllOf(HasSubstr("with culling"), HasSubstr("without culling"),
                                HasSubstr("8 of 8"), HasSubstr("ATE rmse"), HasSubstr(" cm"),
                                HasSubstr((output / "sequence").string())));
  for (const char* name : {"rgb.txt", "groundtruth.txt", "camera.json"}) {
    EXPECT_TRUE(std::filesystem::exists(output / "sequence" / name)) << name;
  }
  const json with = json::parse(ReadFile(output / "with_culling" / "summary.json"));
  const json without = json::parse(ReadFile(output / "without_culling" / "summary.json"));
  EXPECT_EQ(with["input"], without["input"]);
  EXPECT_EQ(with["seed"], 2);
  EXPECT_EQ(with["counts"]["frames_tracked"], 8);
  EXPECT_GT(with["counts"]["mean_masked_share"], 0.02);
  EXPECT_EQ(without["counts"]["mean_masked_share"], 0.0);
  EXPECT_LT(with["trajectory"]["ate"]["translation_m"]["rmse"], 0.02);
  EXPECT_TRUE(std::filesystem::exists(output / "with_culling" / "map.ot"));
  EXPECT_THAT(result.out,
              HasSubstr("Open this in a browser: " + (output / "report.html").string()));
  EXPECT_THAT(ReadFile(output / "report.html").substr(0, 60000),
              AllOf(HasSubstr("with_culling, without_culling"), HasSubstr("side by side")));
}

TEST(Demo, ItsRecordingIsGoodForRun) {
  const TestFolder folder;
  ASSERT_EQ(RunProgram("demo --quiet --frames 3 --output " + folder.path().string()).exit_code, 0);
  const ProgramResult result =
      RunProgram("run --quiet --segmenter masks --output " + (folder.path() / "again").string() +
                 " " + (folder.path() / "sequence").string());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(ReadFile(folder.path() / "again" / "trajectory.txt"),
            ReadFile(folder.path() / "with_culling" / "trajectory.txt"));
}

TEST(Demo, SaysWhereItCannotWrite) {
  const TestFolder folder;
  const std::string file = folder.Write("file", "").string();
  const ProgramResult result = RunProgram("demo --output " + file);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, AllOf(IsOneErrorLine(), HasSubstr(file + ": ")));
}

TEST(Demo, HelpSaysWhatItShowsAndGivesExamples) {
  const ProgramResult result = RunProgram("demo --help");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("--frames"), HasSubstr("--seed"), HasSubstr("out/demo"),
                                HasSubstr("Examples:\n  ofm-slam demo\n")));
}

}  // namespace
}  // namespace ofm
