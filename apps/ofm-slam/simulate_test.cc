#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "test_recording.h"

namespace ofm {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// Arguments of a quiet call.
std::string Quiet(const fs::path& folder, const std::string& more) {
  return "simulate --quiet '" + folder.string() + "' " + more;
}

/// Arguments of a small recording of the small room.
std::string Small(const fs::path& folder, const std::string& more = "") {
  return Quiet(folder, "--scene room --frames 3 --size 96x64 " + more);
}

TEST(Simulate, WritesAFolderThatRunTakes) {
  const TestFolder folder;
  const fs::path output = folder.path() / "new" / "sequence";
  const ProgramResult result = RunProgram(
      Quiet(output, "--frames 3 --size 160x120 --scene room --set room.people=1 --flow"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(result.out, AllOf(HasSubstr(output.string()), HasSubstr("3 frames of 160 x 120")));
  for (const char* name : {"rgb.txt", "depth.txt", "groundtruth.txt", "camera.json", "mask"}) {
    EXPECT_TRUE(fs::exists(output / name)) << name;
  }
  EXPECT_EQ(CountLines(output / "rgb.txt"), 4U);
  const ProgramResult run =
      RunProgram("run --quiet --segmenter masks --set features.count=300 --output '" +
                 (folder.path() / "out").string() + "' '" + output.string() + "'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST(Simulate, MasksNameTheClassesOfWhatANetworkWouldFind) {
  const TestFolder folder;
  const fs::path output = folder.path() / "sequence";
  ASSERT_EQ(RunProgram(Small(output, "--set room.people=1 --path static")).exit_code, 0);
  const auto instances = nlohmann::json::parse(ReadFile(output / "mask" / "1000.000000.json"));
  std::set<std::string> classes;
  for (const auto& instance : instances) classes.insert(instance["category"]);
  EXPECT_TRUE(classes.contains("person"));
  EXPECT_TRUE(classes.contains("dining table"));
  EXPECT_FALSE(classes.contains(""));
}

TEST(Simulate, SameArgumentsGiveTheSameBytesWhateverTheThreads) {
  const TestFolder folder;
  const fs::path a = folder.path() / "a", b = folder.path() / "b", c = folder.path() / "c";
  ASSERT_EQ(RunProgram(Small(a, "--noise kinect --threads 1")).exit_code, 0);
  ASSERT_EQ(RunProgram(Small(b, "--noise kinect --threads 3")).exit_code, 0);
  ASSERT_EQ(RunProgram(Small(c, "--noise kinect --seed 2")).exit_code, 0);
  int files = 0, differ = 0;
  for (const auto& entry : fs::recursive_directory_iterator(a)) {
    if (!entry.is_regular_file()) continue;
    const fs::path name = fs::relative(entry.path(), a);
    EXPECT_EQ(ReadFile(entry.path()), ReadFile(b / name)) << name;
    differ += ReadFile(entry.path()) != ReadFile(c / name);
    ++files;
  }
  EXPECT_EQ(files, 3 * 4 + 6);
  EXPECT_GE(differ, 6);
}

TEST(Simulate, SettingsReachTheSequence) {
  const ProgramResult result = RunProgram(
      "simulate --print-config --path tour --distortion 0.1,-0.2 --fps 15 --set "
      "noise.min_depth_m=1 "
      "--size 320x200");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("kind: tour"), HasSubstr("k1: 0.1"),
                                HasSubstr("k2: -0.2"), HasSubstr("rate_hz: 15"),
                                HasSubstr("min_depth_m: 1"), HasSubstr("height: 200")));
}

TEST(Simulate, BadArgumentsAreNamedInOneLineAndNothingIsWritten) {
  const TestFolder folder;
  const fs::path output = folder.path() / "sequence";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"--size 640", "640x480"},        {"--size 8x8", "--size 8x8"},
      {"--size 640x480x3", "WIDTH"},    {"--path loop", "halfsphere"},
      {"--noise lots", "kinect"},       {"--scene moon", "room"},
      {"--frames 0", "--frames"},       {"--fps 0", "--fps"},
      {"--distortion x", "distortion"}, {"--set room.peple=2", "room.peple"}};
  for (const auto& [arguments, hint] : cases) {
    const ProgramResult result = RunProgram(Quiet(output, arguments));
    EXPECT_EQ(result.exit_code, 1) << arguments;
    EXPECT_THAT(result.err, AllOf(IsOneErrorLine(), HasSubstr(hint))) << arguments;
    EXPECT_FALSE(fs::exists(output)) << arguments;
  }
  EXPECT_THAT(RunProgram("simulate").err, AllOf(IsOneErrorLine(), HasSubstr("OUT")));
}

TEST(Simulate, TouchesNoFolderThatHasSomethingInIt) {
  const TestFolder folder;
  const fs::path file = folder.Write("notes.txt", "mine");
  const ProgramResult result = RunProgram(Small(folder.path()));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              AllOf(IsOneErrorLine(), HasSubstr("not empty"), HasSubstr(folder.path().string())));
  EXPECT_EQ(ReadFile(file), "mine");
  EXPECT_THAT(RunProgram(Small(file)).err, AllOf(IsOneErrorLine(), HasSubstr(file.string())));
  EXPECT_THAT(RunProgram(Small(file / "below")).err,
              AllOf(IsOneErrorLine(), HasSubstr(file.string())));
}

TEST(Simulate, HelpTeaches) {
  const ProgramResult result = RunProgram("simulate --help");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("--path"), HasSubstr("halfsphere"),
                                HasSubstr("Examples:\n  ofm-slam simulate "),
                                HasSubstr("groundtruth.txt"), HasSubstr("same bytes")));
}

}  // namespace
}  // namespace ofm
