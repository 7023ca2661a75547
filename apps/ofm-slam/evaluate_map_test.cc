#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <regex>

#include "test_recording.h"

namespace ofm {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// A short run with true masks, and the evaluation of its map.
class EvaluateMapCommand : public testing::Test {
 protected:
  EvaluateMapCommand() : recording_(12) {}

  ProgramResult Evaluate(const std::string& more = "") const {
    return RunProgram("evaluate-map '" + recording_.output().string() + "' '" +
                      recording_.folder().string() + "' " + more);
  }
  /// The percentage behind a line's name.
  static double Percentage(const ProgramResult& result, const std::string& line) {
    std::smatch found;
    if (!std::regex_search(result.out, found, std::regex(line + ".*\\(([0-9.]+) %"))) return -1;
    return std::stod(found[1]);
  }
  void ExpectError(const testing::Matcher<std::string>& message) const {
    const ProgramResult result = Evaluate();
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(result.err, AllOf(IsOneErrorLine(), message));
  }

  TestRecording recording_;
};

TEST_F(EvaluateMapCommand, CullingKeepsActorsOutOfTheMapAndTheRoomIn) {
  ASSERT_EQ(recording_.Run("--segmenter masks").exit_code, 0);
  const ProgramResult with = Evaluate();
  ASSERT_EQ(with.exit_code, 0) << with.err;
  EXPECT_THAT(with.err, IsEmpty());
  ASSERT_EQ(recording_.Run("--segmenter none --set dynamics.mode=off").exit_code, 0);
  const ProgramResult without = Evaluate();
  ASSERT_EQ(without.exit_code, 0) << without.err;
  EXPECT_GE(Percentage(with, "actors"), 0);
  EXPECT_LT(Percentage(with, "actors"), 5);
  EXPECT_GT(Percentage(without, "actors"), 20);
  EXPECT_GT(Percentage(with, "static"), 50);
}

TEST_F(EvaluateMapCommand, TheRoomWithoutActorsTellsWhatIsMappedAndHowWell) {
  ASSERT_EQ(recording_.Run("--segmenter masks").exit_code, 0);
  const std::filesystem::path base = recording_.root() / "base", json = recording_.root() / "j";
  SimSequenceOptions options;
  options.frames = 12;
  options.rate_hz = 15;
  options.camera = MakeSimCamera(240, 180);
  options.room.people = 0;
  WriteTumSequence(SimSequence(options), base);
  const std::string arguments = "--static '" + base.string() + "' --json '" + json.string() + "'";
  const ProgramResult result = Evaluate(arguments);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GT(Percentage(result, "surface"), 60);
  const auto figures = nlohmann::json::parse(ReadFile(json));
  EXPECT_EQ(figures["resolution_m"], .1);
  EXPECT_GT(figures["surface_share_mapped"], .6);
  EXPECT_GT(figures["points"], 500);
  EXPECT_GT(figures["median_distance_m"], 0);
  EXPECT_LT(figures["median_distance_m"], .03);
  EXPECT_LE(figures["surface_voxels_seen_mapped"], figures["surface_voxels_seen"]);
  EXPECT_LT(figures["surface_voxels_seen"], figures["surface_voxels"]) << "people hide some";
  ASSERT_EQ(Evaluate(arguments + " --depth-delay 0.3").exit_code, 0);
  EXPECT_GT(nlohmann::json::parse(ReadFile(json))["median_distance_m"],
            figures["median_distance_m"]);
  std::filesystem::remove(recording_.output() / "map.ply");
  const ProgramResult without = Evaluate(arguments);
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_THAT(without.err, AllOf(IsOneErrorLine(), HasSubstr("map.ply: does not exist")));
}

TEST_F(EvaluateMapCommand, BadInputIsOneLineThatNamesTheFile) {
  ExpectError(HasSubstr((recording_.output() / "camera.yaml").string()));
  ASSERT_EQ(recording_.Run().exit_code, 0);
  const std::filesystem::path octree = recording_.output() / "map.ot";
  std::filesystem::resize_file(octree, std::filesystem::file_size(octree) / 2);
  ExpectError(HasSubstr(octree.string() + ": is truncated"));
  std::ofstream(octree) << "a text";
  ExpectError(HasSubstr(octree.string() + ": is no OctoMap file"));
  ASSERT_EQ(recording_.Run().exit_code, 0);
  const std::filesystem::path mask =
      recording_.folder() / "mask" / recording_.ColorImage(3).filename();
  ASSERT_TRUE(cv::imwrite(mask.string(), cv::Mat(18, 24, CV_8UC1, cv::Scalar(0))));
  ExpectError(HasSubstr(mask.string() + ": is no 8-bit instance mask of the frame's size"));
  std::filesystem::remove(mask);
  ExpectError(HasSubstr(mask.string() + ": does not exist"));
  std::filesystem::remove(recording_.folder() / "groundtruth.txt");
  ExpectError(HasSubstr(recording_.folder().string() + ": has no groundtruth.txt"));
}

}  // namespace
}  // namespace ofm
