// Maps that are saved by one run and used by another, as a user does it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "test_recording.h"

namespace ofm {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A recording of which the first frames were mapped.
class MapFiles : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    recording_.emplace(16);
    const ProgramResult result = Run("first", "--frames 10 --save-map " + Map());
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("saved map   " + Map()));
  }
  static void TearDownTestSuite() { recording_.reset(); }

  static std::filesystem::path Folder(const std::string& name) { return recording_->root() / name; }
  static std::string Map() { return Folder("room.ofm").string(); }
  static std::string Arguments(const std::string& output, const std::string& more) {
    return "run " + recording_->folder().string() + " --output " + Folder(output).string() +
           " --quiet --segmenter masks --set features.count=400 --set dense.resolution_m=0.1 " +
           more;
  }
  static ProgramResult Run(const std::string& output, const std::string& more) {
    return RunProgram(Arguments(output, more));
  }
  static json Summary(const std::string& output) {
    return json::parse(ReadFile(Folder(output) / "summary.json"));
  }

  static std::optional<TestRecording> recording_;
};

std::optional<TestRecording> MapFiles::recording_;

TEST_F(MapFiles, LocaliseOnlyFollowsTheCameraAndChangesNothing) {
  const std::string before = ReadFile(Map());
  const ProgramResult result = Run("later", "--start 10 --load-map " + Map() + " --localize-only");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("6 tracked of 6"), HasSubstr("loaded map  " + Map()),
                                HasSubstr("in the loaded map's world")));
  const json summary = Summary("later");
  EXPECT_EQ(summary["loaded_map"], Map());
  EXPECT_EQ(summary["counts"]["keyframes_made"], 0);
  EXPECT_EQ(summary["counts"]["keyframes"], Summary("first")["counts"]["keyframes"]);
  EXPECT_LT(summary["trajectory_in_map"]["ate"]["translation_m"]["rmse"], 0.03);
  EXPECT_FALSE(std::filesystem::exists(Folder("later") / "map.ot")) << "there is nothing to map";
  EXPECT_TRUE(ReadFile(Map()) == before);
}

TEST_F(MapFiles, EvaluateMeasuresInTheMapsWorld) {
  ASSERT_EQ(Run("again", "--start 10 --load-map " + Map() + " --localize-only").exit_code, 0);
  const std::string arguments = "evaluate " + (Folder("again") / "trajectory.txt").string() + " " +
                                (recording_->folder() / "groundtruth.txt").string() + " --json " +
                                Folder("errors.json").string() + " --align-with ";
  for (const std::string& with : {Map(), (Folder("first") / "keyframes.txt").string()}) {
    const ProgramResult result = RunProgram(arguments + with);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json errors = json::parse(ReadFile(Folder("errors.json")));
    EXPECT_NEAR(errors["ate"]["translation_m"]["rmse"].get<double>(),
                Summary("again")["trajectory_in_map"]["ate"]["translation_m"]["rmse"].get<double>(),
                1e-6);
  }
  const ProgramResult wrong = RunProgram(arguments + Map() + "x");
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_THAT(wrong.err, AllOf(IsOneErrorLine(), HasSubstr("--align-with " + Map() + "x")));
}

TEST_F(MapFiles, ARunGoesOnWithAMapAndSavesMoreOfIt) {
  const std::string grown = Folder("grown.ofm").string();
  const std::string more = "--start 10 --load-map " + Map() + " --save-map " + grown +
                           " --set tracking.keyframe.max_frames=2";
  ASSERT_EQ(Run("grown", more).exit_code, 0);
  const json summary = Summary("grown");
  EXPECT_EQ(summary["counts"]["frames_tracked"], 6);
  EXPECT_GE(summary["counts"]["keyframes_made"], 1);
  EXPECT_GT(std::filesystem::file_size(grown), std::filesystem::file_size(Map()));
  EXPECT_TRUE(std::filesystem::exists(Folder("grown") / "map.ot"));

  const std::string first = ReadFile(grown);
  ASSERT_EQ(Run("grown", more).exit_code, 0);
  EXPECT_TRUE(ReadFile(grown) == first) << "the same again gives the same bytes";
}

TEST_F(MapFiles, ACameraThatNeverFindsItsPlaceIsSaidNotTo) {
  const ProgramResult result =
      Run("nowhere", "--start 10 --frames 2 --load-map " + Map() +
                         " --localize-only --set tracking.min_relocalization_inliers=1000");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("0 tracked of 2"), HasSubstr("its place was never recognised")));
}

TEST_F(MapFiles, InfoTellsWhatIsInside) {
  const ProgramResult result = RunProgram("map info " + Map());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json counts = Summary("first")["counts"];
  EXPECT_THAT(
      result.out,
      AllOf(HasSubstr("version 2"), HasSubstr("keyframes  " + counts["keyframes"].dump() + "\n"),
            HasSubstr("landmarks  " + counts["landmarks"].dump() + "\n"), HasSubstr("240 x 180 px"),
            HasSubstr("no distortion"), HasSubstr("8 levels")));
}

TEST_F(MapFiles, ADamagedFileIsOneErrorLineBeforeAnythingIsWritten) {
  std::string bytes = ReadFile(Map());
  bytes[bytes.size() / 2] ^= 1;
  const std::string damaged = Folder("damaged.ofm").string();
  std::ofstream(damaged, std::ios::binary) << bytes;
  for (const std::string& arguments :
       {"map info " + damaged, Arguments("none", "--load-map " + damaged)}) {
    const ProgramResult result = RunProgram(arguments);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, AllOf(IsOneErrorLine(), HasSubstr("damaged.ofm: is damaged")));
  }
  EXPECT_FALSE(std::filesystem::exists(Folder("none")));
}

TEST_F(MapFiles, WhatDoesNotFitIsOneErrorLine) {
  const std::pair<std::string, const char*> cases[] = {
      {"--load-map /nowhere/a.ofm", "/nowhere/a.ofm: does not exist"},
      {"--load-map " + Map() + " --camera tum-fr1",
       "made with camera.width = 240, but here it is 640"},
      {"--load-map " + Map() + " --set features.levels=6", "made with features.levels = 8"},
      {"--load-map " + Map() + " --vocabulary " + Map(), "room.ofm: "},
      {"--save-map /nowhere/a.ofm", "/nowhere/a.ofm: cannot be written"},
      {"--localize-only", "--localize-only requires --load-map"},
      {"--set localize_only=true", "localize_only needs a map"},
      {"--localize-only --load-map " + Map() + " --save-map x.ofm", "excludes"}};
  for (const auto& [arguments, reason] : cases) {
    const ProgramResult result = Run("bad", arguments);
    EXPECT_EQ(result.exit_code, 1) << arguments;
    EXPECT_THAT(result.err, AllOf(IsOneErrorLine(), HasSubstr(reason))) << arguments;
  }
}

TEST_F(MapFiles, ACameraThatDiffersInOneNumberIsNamed) {
  const std::string camera = Folder("camera.json").string();
  std::string text = ReadFile(recording_->folder() / "camera.json");
  const std::size_t fx = text.find("\"fx\"");
  text.replace(text.find(':', fx), text.find(',', fx) - text.find(':', fx), ": 200.5");
  std::ofstream(camera) << text;
  const ProgramResult result = Run("bad", "--load-map " + Map() + " --camera " + camera);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(IsOneErrorLine(), HasSubstr("was made with camera.fx = "),
                                HasSubstr("here it is 200.5; choose the map's --camera")));
}

TEST_F(MapFiles, AFullDiskLeavesTheOldMapAndTheOtherResults) {
  const std::string old = Folder("old.ofm").string();
  std::filesystem::copy_file(Map(), old);
  const std::string limited =
      "ulimit -f 50; '" OFM_PROGRAM "' " +  // blocks; a map has more
      Arguments("full", "--frames 4 --set build_semantic_map=false --set build_objects=false") +
      " --save-map " + old + " 2> " + Folder("errors").string();
  EXPECT_NE(std::system(limited.c_str()), 0);
  EXPECT_THAT(ReadFile(Folder("errors")), HasSubstr("old.ofm: cannot be written: File too large"));
  EXPECT_TRUE(ReadFile(old) == ReadFile(Map()));
  EXPECT_EQ(CountPoses(Folder("full") / "trajectory.txt"), 4U);
}

}  // namespace
}  // namespace ofm
