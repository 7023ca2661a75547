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

json Summary(const std::filesystem::path& output) {
  return json::parse(ReadFile(output / "summary.json"));
}

TEST(Run, WritesAllFilesAndPrintsASummary) {
  const TestRecording recording(12);
  const ProgramResult result = recording.Run("--segmenter masks --seed 5");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(result.out, AllOf(HasSubstr("12 tracked of 12 (100.0 %)"), HasSubstr("keyframes"),
                                HasSubstr("against ground truth"),
                                HasSubstr("results in " + recording.output().string())));
  for (const char* name : {"trajectory.txt", "trajectory_live.txt", "keyframes.txt", "map.ply",
                           "map.ot", "map.bt", "map_labels.csv", "config.yaml", "camera.yaml",
                           "summary.json", "frames.csv", "times.csv"}) {
    EXPECT_TRUE(std::filesystem::is_regular_file(recording.output() / name)) << name;
  }
  EXPECT_FALSE(std::filesystem::is_empty(recording.output() / "keyframes"));
  EXPECT_EQ(CountPoses(recording.output() / "trajectory.txt"), 12U);
  const json summary = Summary(recording.output());
  EXPECT_EQ(summary["seed"], 5);
  EXPECT_EQ(summary["version"], OFM_VERSION);
  EXPECT_EQ(summary["runner"], "sequential");
  EXPECT_EQ(summary["counts"]["frames_tracked"], 12);
  EXPECT_GT(summary["counts"]["mean_masked_share"], 0.01);
  EXPECT_LT(summary["trajectory"]["ate"]["translation_m"]["rmse"], 0.02);
  EXPECT_LT(summary["trajectory_live"]["ate"]["translation_m"]["rmse"], 0.03);
}

TEST(Run, MeasuresCullingAgainstTrueMasks) {
  const TestRecording recording(8);
  const std::string masks = (recording.folder() / "mask").string();
  const ProgramResult result = recording.Run("--segmenter masks --true-masks " + masks);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("of the features on true actors"));
  const json culling = Summary(recording.output())["culling"];
  EXPECT_GT(culling["actor_features"], 0);
  EXPECT_GT(culling["static_features"], culling["actor_features"]);
  EXPECT_LT(culling["actor_share_in_pose"], 0.03);
  EXPECT_GT(culling["static_share_kept"], 0.7);
}

TEST(Run, OnWrittenMasksGivesTheSameBytes) {
  const TestRecording recording(8);
  const auto folder = recording.output() / "written";
  ASSERT_EQ(recording.Run("--segmenter masks --write-masks " + folder.string()).exit_code, 0);
  const std::string first = ReadFile(recording.output() / "trajectory.txt");
  std::filesystem::remove_all(recording.folder() / "mask");
  const std::string again = "--segmenter masks --set perception.masks_folder=" + folder.string();
  ASSERT_EQ(recording.Run(again).exit_code, 0);
  EXPECT_EQ(ReadFile(recording.output() / "trajectory.txt"), first);
}

TEST(Run, TrueMasksThatAreNotThereAreAnErrorBeforeTheRun) {
  const TestRecording recording(3);
  const ProgramResult result = recording.Run("--true-masks /nowhere/masks");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("/nowhere/masks"));
}

TEST(Run, DrawsDebugViewsAsFramesAndAsAVideo) {
  const TestRecording recording(4);
  const auto frames = recording.root() / "frames", video = recording.root() / "video.avi";
  ASSERT_EQ(recording.Run("--segmenter masks --debug-video " + frames.string()).exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_regular_file(frames / "000000.jpg"));
  EXPECT_TRUE(std::filesystem::is_regular_file(frames / "000003.jpg"));
  ASSERT_EQ(recording.Run("--segmenter masks --debug-video " + video.string()).exit_code, 0);
  EXPECT_GT(std::filesystem::file_size(video), 4000U);
  const ProgramResult other =
      recording.Run("--debug-video " + (recording.root() / "v.mov").string());
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.err, HasSubstr("name an .avi file, or a folder"));
}

TEST(Run, ItsTrajectoryCanBeEvaluated) {
  const TestRecording recording(10);
  ASSERT_EQ(recording.Run("--segmenter masks").exit_code, 0);
  const ProgramResult result = RunProgram(
      "evaluate " + (recording.output() / "trajectory.txt").string() + " " +
      (recording.folder() / "groundtruth.txt").string() + " --sequence " +
      recording.folder().string() + " --json " + (recording.root() / "errors.json").string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json errors = json::parse(ReadFile(recording.root() / "errors.json"));
  EXPECT_EQ(errors["coverage"]["ratio"], 1.0);
  // The file holds nine decimals.
  EXPECT_NEAR(
      errors["ate"]["translation_m"]["rmse"].get<double>(),
      Summary(recording.output())["trajectory"]["ate"]["translation_m"]["rmse"].get<double>(),
      1e-7);
}

TEST(Run, SameSeedGivesTheSameBytes) {
  const TestRecording recording(8);
  const std::filesystem::path first = recording.root() / "first", second = recording.output();
  ASSERT_EQ(recording.Run("--seed 3").exit_code, 0);
  std::filesystem::rename(recording.output(), first);
  ASSERT_EQ(recording.Run("--seed 3").exit_code, 0);
  for (const char* name : {"trajectory.txt", "trajectory_live.txt", "keyframes.txt", "map.ply",
                           "map.ot", "map.bt", "map_labels.csv", "config.yaml", "camera.yaml"}) {
    EXPECT_TRUE(ReadFile(first / name) == ReadFile(second / name)) << name;
  }
}

TEST(Run, ThreadedTracksTheSameFrames) {
  const TestRecording recording(10);
  const ProgramResult result = recording.Run("--threaded --segmenter masks");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json summary = Summary(recording.output());
  EXPECT_EQ(summary["runner"], "threaded");
  EXPECT_EQ(summary["counts"]["frames_tracked"], 10);
  EXPECT_LT(summary["trajectory"]["ate"]["translation_m"]["rmse"], 0.02);
}

TEST(Run, RealtimeKeepsThePaceAndCountsWhatItDrops) {
  const TestRecording recording(12, 1000);  // no machine is that fast
  const ProgramResult result = recording.Run("--realtime --realtime-queue 4");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json summary = Summary(recording.output());
  const json counts = summary["counts"];
  EXPECT_GT(counts["frames_dropped"], 0) << "four can wait";
  EXPECT_EQ(summary["pose_delays"]["count"], counts["frames"]);
  EXPECT_GT(summary["pose_delays"]["median_ms"], 0);
  EXPECT_NE(result.out.find("from a frame to its pose"), std::string::npos);
  EXPECT_EQ(counts["frames"].get<int>() + counts["frames_dropped"].get<int>(), 12);
  EXPECT_EQ(CountPoses(recording.output() / "trajectory_live.txt"), counts["frames_tracked"]);
}

TEST(Run, RealtimeDropsNothingWhereAllFramesCanWait) {
  const TestRecording recording(12, 1000);
  ASSERT_EQ(recording.Run("--realtime --realtime-queue 12").exit_code, 0);
  EXPECT_EQ(Summary(recording.output())["counts"]["frames_dropped"], 0);
  EXPECT_NE(recording.Run("--realtime --realtime-queue 0").exit_code, 0);
}

TEST(Run, RealtimeTakesAsLongAsTheRecording) {
  const TestRecording recording(4, 4);
  ASSERT_EQ(recording.Run("--realtime").exit_code, 0);
  EXPECT_GE(Summary(recording.output())["wall_s"], 0.75);
}

TEST(Run, PlaysOnlyTheFramesThatAreAskedFor) {
  const TestRecording recording(8);
  ASSERT_EQ(recording.Run("--start 2 --frames 4").exit_code, 0);
  const json summary = Summary(recording.output());
  EXPECT_EQ(summary["counts"]["frames"], 4);
  EXPECT_EQ(summary["trajectory"]["coverage"]["frames"], 4);
  EXPECT_EQ(summary["trajectory"]["coverage"]["ratio"], 1.0);
}

TEST(Run, InterruptKeepsTheResultsUpToThere) {
  const TestRecording recording(40, 2);  // 20 s at its pace
  const std::filesystem::path log = recording.root() / "progress";
  const ProgramResult result = RunProgram(
      recording.Arguments("--realtime 2> " + log.string() + " & pid=$!; until grep -q frames " +
                          log.string() + "; do sleep 0.05; done; kill -INT $pid; wait $pid"));
  ASSERT_EQ(result.exit_code, 0) << ReadFile(log);
  const std::size_t poses = CountPoses(recording.output() / "trajectory.txt");
  EXPECT_GE(poses, 1U);
  EXPECT_LT(poses, 40U);
  EXPECT_EQ(Summary(recording.output())["counts"]["frames_tracked"], poses);
  EXPECT_TRUE(std::filesystem::exists(recording.output() / "map.ot"));
}

TEST(Run, ProgressTellsFramesRateStateMapAndMask) {
  const TestRecording recording(5);
  const ProgramResult result = RunProgram(recording.Arguments("--segmenter masks"));
  ASSERT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, AllOf(HasSubstr("] 5/5 frames, "), HasSubstr(" fps, tracking, "),
                                HasSubstr(" keyframes, "), HasSubstr(" landmarks, "),
                                HasSubstr(" % masked\n")));
  EXPECT_THAT(result.err, HasSubstr("[####################] 5/5")) << "the bar is full";
  EXPECT_THAT(result.err, testing::Not(HasSubstr("\r"))) << "this is no terminal";
}

TEST(Run, WithoutGroundTruthItRunsAndTellsNoErrors) {
  const TestRecording recording(4);
  std::filesystem::remove(recording.folder() / "groundtruth.txt");
  const ProgramResult result = recording.Run();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, testing::Not(HasSubstr("ground truth")));
  EXPECT_FALSE(Summary(recording.output()).contains("trajectory"));
}

TEST(Run, FindsPeopleWithANetwork) {
  const std::string model = OFM_SHARED_DIR "/models/yolov8n-seg_256x320.onnx";
  if (!std::filesystem::exists(model)) GTEST_SKIP() << model << " is not there";
  const TestRecording recording(3);
  const ProgramResult result = recording.Run("--segmenter yolo-seg --model " + model);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json summary = Summary(recording.output());
  EXPECT_EQ(summary["counts"]["frames_tracked"], 3);
  EXPECT_EQ(summary["stages"]["segmentation"]["wall"]["count"], 3);
}

}  // namespace
}  // namespace ofm
