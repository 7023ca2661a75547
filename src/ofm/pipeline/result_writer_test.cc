#include "ofm/pipeline/result_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <array>
#include <nlohmann/json.hpp>

#include "ofm/io/camera_file.h"
#include "ofm/io/read_file.h"
#include "ofm/io/test_folder.h"
#include "ofm/io/trajectory_file.h"
#include "ofm/pipeline/frame_table.h"
#include "ofm/pipeline/test_support.h"

namespace ofm {
namespace {

using nlohmann::json;
using test::Recording;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::array kFiles = {
    "trajectory.txt", "trajectory_live.txt", "keyframes.txt", "map.ply",      "map.ot",
    "map.bt",         "map_labels.csv",      "map.pgm",       "map.yaml",     "config.yaml",
    "camera.yaml",    "summary.json",        "objects.db",    "objects.json", "frames.csv",
    "times.csv"};

/// What a real run leaves.
RunOutcome RunOnce(const Recording& recording) {
  test::PlaySource source(recording.images);
  return RunSequential(*test::MakeSlam(recording), source, {});
}

RunDescription Describe(const Recording& recording) {
  RunDescription description;
  description.version = "1.2.3";
  description.input = "some/desk";
  description.runner = "sequential";
  description.camera = recording.sequence.camera();
  return description;
}

/// The summary without what no two runs have in common.
json WithoutTimings(const std::filesystem::path& file) {
  json summary = json::parse(ReadFile(file));
  for (const char* key : {"wall_s", "process_cpu_s", "peak_memory_mib", "stages"}) {
    EXPECT_EQ(summary.erase(key), 1U) << key;
  }
  return summary;
}

TEST(WriteResults, WritesEveryFileAndNothingElse) {
  const Recording recording(5);
  const TestFolder folder;
  WriteResults(folder.path(), RunOnce(recording), test::QuickOptions(), Describe(recording));
  for (const char* name : kFiles) {
    EXPECT_TRUE(std::filesystem::is_regular_file(folder.path() / name)) << name;
    EXPECT_FALSE(std::filesystem::is_empty(folder.path() / name)) << name;
  }
  EXPECT_EQ(folder.CountEntries(), kFiles.size());
}

TEST(WriteResults, FilesAreReadBackAsWhatTheyAre) {
  const Recording recording(5);
  const RunOutcome outcome = RunOnce(recording);
  const TestFolder folder;
  WriteResults(folder.path(), outcome, test::QuickOptions(), Describe(recording));
  EXPECT_EQ(LoadTrajectory(folder.path() / "trajectory.txt").size(), outcome.trajectory.size());
  EXPECT_EQ(LoadTrajectory(folder.path() / "keyframes.txt").size(), outcome.counts.keyframes);
  EXPECT_EQ(LoadFrames(folder.path() / "frames.csv").size(), 5U);
  const FrameTimes times = LoadFrameTimes(folder.path() / "times.csv");
  EXPECT_EQ(times.stamps_ns.size(), 5U);
  EXPECT_THAT(times.stages, testing::IsSupersetOf({"features", "tracking"}));
  EXPECT_EQ(LoadCamera(folder.path() / "camera.yaml").fx, recording.sequence.camera().fx);
  EXPECT_THAT(ReadFile(folder.path() / "map.ply"), testing::StartsWith("ply\n"));
  const std::unique_ptr<octomap::AbstractOcTree> tree(
      octomap::AbstractOcTree::read((folder.path() / "map.ot").string()));
  ASSERT_NE(dynamic_cast<octomap::ColorOcTree*>(tree.get()), nullptr);
  EXPECT_GT(tree->size(), 100U);
  octomap::OcTree binary(0.1);
  ASSERT_TRUE(binary.readBinary((folder.path() / "map.bt").string()));
  EXPECT_DOUBLE_EQ(binary.getResolution(), test::QuickOptions().dense.resolution_m);
}

TEST(WriteResults, ConfigLoadsBackToTheSameOptions) {
  const Recording recording(1);
  SlamOptions options = test::QuickOptions();
  options.seed = 42;
  options.perception.model = "models/a network.onnx";
  options.dynamics.dynamic_classes = {"person", "dog"};
  options.features.scale_factor = 1.234567890123;
  const TestFolder folder;
  WriteResults(folder.path(), {}, options, Describe(recording));
  SlamOptions loaded;
  LoadOptionsYaml(folder.path() / "config.yaml", OptionFields(loaded));
  EXPECT_EQ(PrintOptionsYaml(OptionFields(loaded)), PrintOptionsYaml(OptionFields(options)));
  EXPECT_EQ(loaded.seed, 42U);
  EXPECT_EQ(loaded.perception.model, options.perception.model);
  EXPECT_EQ(loaded.features.scale_factor, options.features.scale_factor);
}

TEST(WriteResults, SameSeedGivesTheSameBytesInEveryFile) {
  const Recording recording(12);
  const TestFolder first, second;
  for (const TestFolder* folder : {&first, &second}) {
    WriteResults(folder->path(), RunOnce(recording), test::QuickOptions(), Describe(recording));
  }
  for (const std::string name : kFiles) {
    if (name == "summary.json" || name == "times.csv") continue;
    EXPECT_TRUE(ReadFile(first.path() / name) == ReadFile(second.path() / name)) << name;
  }
  EXPECT_EQ(WithoutTimings(first.path() / "summary.json"),
            WithoutTimings(second.path() / "summary.json"));
}

TEST(WriteResults, CloudFormatsAndColorsCanBeChosen) {
  const Recording recording(5);
  const RunOutcome outcome = RunOnce(recording);
  const TestFolder folder;
  const auto write = [&](CloudFormat format, MapColor color) {
    SlamOptions options = test::QuickOptions();
    options.dense.cloud_file = {format, color};
    options.dense.octree.color = color;
    WriteResults(folder.path(), outcome, options, Describe(recording));
  };
  write(CloudFormat::kBoth, MapColor::kAppearance);
  const std::string ply = ReadFile(folder.path() / "map.ply");
  const std::string ot = ReadFile(folder.path() / "map.ot");
  EXPECT_THAT(ReadFile(folder.path() / "map.pcd"), testing::StartsWith("# .PCD v0.7"));
  write(CloudFormat::kPly, MapColor::kLabel);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "map.pcd")) << "of the run before";
  EXPECT_TRUE(ply != ReadFile(folder.path() / "map.ply"));
  EXPECT_TRUE(ot != ReadFile(folder.path() / "map.ot"));
  write(CloudFormat::kPcd, MapColor::kAppearance);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "map.ply"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "map.pcd"));
}

TEST(WriteResults, WithoutASemanticMapItWritesNone) {
  const Recording recording(1);
  const TestFolder folder;
  WriteResults(folder.path(), {}, {}, Describe(recording));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "map.ot"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "summary.json"));
}

TEST(WriteResults, NamesAFileThatCannotBeWritten) {
  const Recording recording(1);
  const TestFolder folder;
  std::filesystem::create_directories(folder.path() / "keyframes.txt" / "in_the_way");
  EXPECT_THAT(ErrorOf([&] { WriteResults(folder.path(), {}, {}, Describe(recording)); }),
              HasSubstr("keyframes.txt"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "trajectory.txt")) << "those before it";
}

TEST(WriteResults, SubmapsThatWereNotJoinedHaveFilesOfTheirOwn) {
  const Recording recording(2);
  const TestFolder folder;
  folder.Write("trajectory_submap_3.txt", "of an earlier run");
  RunOutcome outcome;
  outcome.submap = SubmapId(4);
  outcome.counts.submaps_begun = 2;
  outcome.loop_counts.joined = 1;
  outcome.trajectory = recording.sequence.GroundTruth();
  outcome.unjoined = {{SubmapId(0), 5, {outcome.trajectory.front()}}, {SubmapId(9), 1, {}}};
  WriteResults(folder.path(), outcome, {}, Describe(recording));
  EXPECT_EQ(LoadTrajectory(folder.path() / "trajectory_submap_0.txt").size(), 1U);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "trajectory_submap_9.txt"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "trajectory_submap_3.txt"));
  const json submaps = json::parse(ReadFile(folder.path() / "summary.json"))["submaps"];
  EXPECT_EQ(submaps["world"], 4);
  EXPECT_EQ(submaps["begun"], 2);
  EXPECT_EQ(submaps["joined"], 1);
  ASSERT_EQ(submaps["unjoined"].size(), 2U);
  EXPECT_EQ(submaps["unjoined"][0]["keyframes"], 5);
  EXPECT_EQ(submaps["unjoined"][0]["trajectory"], "trajectory_submap_0.txt");
  EXPECT_EQ(submaps["unjoined"][1]["frames"], 0);
  EXPECT_FALSE(submaps["unjoined"][1].contains("trajectory"));
}

TEST(SummaryJson, TellsWhichLoopsJoinedSubmaps) {
  RunOutcome outcome;
  outcome.loops.resize(2);
  outcome.loops[1].join = {SubmapId(7), SubmapId(2)};
  const json list = json::parse(SummaryJson(outcome, {}, {}))["loops"]["list"];
  EXPECT_TRUE(list[0].contains("drift_m"));
  EXPECT_FALSE(list[0].contains("joined_submap"));
  EXPECT_FALSE(list[1].contains("drift_m"));
  EXPECT_EQ(list[1]["joined_submap"], 7);
  EXPECT_EQ(list[1]["into_submap"], 2);
}

TEST(SummaryJson, HasCountsErrorsTimesVersionsAndSeed) {
  const Recording recording(5);
  const RunOutcome outcome = RunOnce(recording);
  SlamOptions options = test::QuickOptions();
  options.seed = 9;
  RunDescription description = Describe(recording);
  description.evaluation = EvaluateTrajectory(outcome.trajectory, recording.sequence.GroundTruth(),
                                              {.frames = std::size_t{5}});
  const json summary = json::parse(SummaryJson(outcome, options, description));
  EXPECT_EQ(summary["version"], "1.2.3");
  EXPECT_EQ(summary["input"], "some/desk");
  EXPECT_EQ(summary["runner"], "sequential");
  EXPECT_EQ(summary["seed"], 9);
  EXPECT_TRUE(summary["error"].is_null());
  EXPECT_TRUE(summary["libraries"].contains("opencv"));
  EXPECT_TRUE(summary["libraries"].contains("ceres"));
  EXPECT_EQ(summary["counts"]["frames"], 5);
  EXPECT_EQ(summary["counts"]["frames_tracked"], 5);
  EXPECT_EQ(summary["counts"]["tracked_share"], 1.0);
  EXPECT_EQ(summary["counts"]["frames_dropped"], 0);
  EXPECT_EQ(summary["counts"]["keyframes"], outcome.counts.keyframes);
  EXPECT_EQ(summary["trajectory"]["ate"]["pairs"], 5);
  EXPECT_EQ(summary["trajectory"]["coverage"]["ratio"], 1.0);
  EXPECT_FALSE(summary.contains("trajectory_live"));
  EXPECT_EQ(summary["map"]["cloud_points"], outcome.semantic_map->cloud_in_world.size());
  EXPECT_EQ(summary["stages"]["tracking"]["cpu"]["count"], 5);
  EXPECT_GT(summary["stages"]["features"]["wall"]["median_ms"], 0);
  EXPECT_GT(summary["wall_s"], 0);
  EXPECT_GT(summary["peak_memory_mib"], 1);
}

TEST(SummaryJson, TellsOfLoops) {
  RunOutcome outcome;
  outcome.loop_counts.closed = 1;
  outcome.loop_counts.similar = 9;
  outcome.loop_counts.no_alignment = 3;
  LoopRecord loop;
  loop.keyframe_stamp_ns = 12'500'000'000;
  loop.place_stamp_ns = 2'000'000'000;
  loop.place_from_keyframe = {Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.5, 0, -1)};
  loop.matches = 77;
  loop.landmarks_fused = 60;
  outcome.loops = {loop};
  const json loops = json::parse(SummaryJson(outcome, {}, {}))["loops"];
  EXPECT_EQ(loops["closed"], 1);
  EXPECT_EQ(loops["similar"], 9);
  EXPECT_EQ(loops["rejected_no_alignment"], 3);
  ASSERT_EQ(loops["list"].size(), 1U);
  EXPECT_EQ(loops["list"][0]["stamp"], "12.500000");
  EXPECT_EQ(loops["list"][0]["place_stamp"], "2.000000");
  EXPECT_EQ(loops["list"][0]["matches"], 77);
  EXPECT_EQ(loops["list"][0]["landmarks_fused"], 60);
  EXPECT_EQ(loops["list"][0]["place_from_keyframe"], json({0.5, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0}));
}

TEST(SummaryJson, TellsWhyARunEndedEarly) {
  RunOutcome outcome;
  outcome.error = "/x/7.png: is \"truncated\"";
  const json summary = json::parse(SummaryJson(outcome, {}, {}));
  EXPECT_EQ(summary["error"], outcome.error);
  EXPECT_EQ(summary["counts"]["tracked_share"], 0.0);
}

TEST(SummaryJson, NamesTheMapsThatWereLoadedAndSaved) {
  const Recording recording(2);
  const Trajectory truth = recording.sequence.GroundTruth();
  RunDescription description;
  const json without = json::parse(SummaryJson({}, {}, description));
  for (const char* key : {"loaded_map", "saved_map", "trajectory_in_map"}) {
    EXPECT_FALSE(without.contains(key)) << key;
  }
  description.loaded_map = "a.ofm";
  description.saved_map = "b.ofm";
  description.evaluation_in_map = EvaluateTrajectory(truth, truth);
  const json summary = json::parse(SummaryJson({}, {}, description));
  EXPECT_EQ(summary["loaded_map"], "a.ofm");
  EXPECT_EQ(summary["saved_map"], "b.ofm");
  EXPECT_EQ(summary["trajectory_in_map"]["ate"]["pairs"], 2);
}

TEST(PrepareOutputFolder, MakesTheFolderAndLeavesNothingInIt) {
  const TestFolder folder;
  const std::filesystem::path made = folder.path() / "a" / "b";
  PrepareOutputFolder(made);
  EXPECT_TRUE(std::filesystem::is_empty(made));
  PrepareOutputFolder(made);  // that it exists is no error
}

TEST(PrepareOutputFolder, SaysWhatToDoWhereItCannotBeMade) {
  const TestFolder folder;
  const std::filesystem::path file = folder.Write("file", "");
  EXPECT_THAT(ErrorOf([&] { PrepareOutputFolder(file / "out"); }),
              AllOf(HasSubstr((file / "out").string()), HasSubstr("--output")));
  EXPECT_THAT(ErrorOf([&] { PrepareOutputFolder(file); }), HasSubstr("--output"));
}

TEST(PrepareOutputFolder, SaysWhatToDoWhereItCannotBeWrittenTo) {
  // Of all folders this one lets nobody write, not even root.
  if (!std::filesystem::is_directory("/proc/self")) GTEST_SKIP() << "no /proc here";
  EXPECT_THAT(ErrorOf([] { PrepareOutputFolder("/proc/self"); }),
              AllOf(HasSubstr("/proc/self: cannot be written to"), HasSubstr("--output")));
}

}  // namespace
}  // namespace ofm
