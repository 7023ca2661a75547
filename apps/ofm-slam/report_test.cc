// Reports and plots of a run, made as a user does it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "test_recording.h"

namespace ofm {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

/// A run of 12 frames with masks, made once for all tests.
class ReportCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    recording_ = std::make_unique<TestRecording>(12);
    ASSERT_EQ(recording_->Run("--segmenter masks").exit_code, 0);
  }
  static void TearDownTestSuite() { recording_.reset(); }

  static std::string Out() {
    std::string quoted = recording_->output().string();
    return quoted.insert(0, 1, '\'') += '\'';
  }
  std::filesystem::path File(const char* name) const { return folder_.path() / name; }
  static void ExpectError(const std::string& arguments, const char* reason) {
    const ProgramResult result = RunProgram(arguments);
    EXPECT_EQ(result.exit_code, 1) << arguments;
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(result.err, AllOf(IsOneErrorLine(), HasSubstr(reason))) << arguments;
  }

  static std::unique_ptr<TestRecording> recording_;
  TestFolder folder_;
};

std::unique_ptr<TestRecording> ReportCommand::recording_;

TEST_F(ReportCommand, MakesAPageOfARun) {
  const ProgramResult result = RunProgram("report " + Out());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  const auto file = recording_->output() / "report.html";
  EXPECT_THAT(result.out, AllOf(StartsWith(file.string()), HasSubstr("MB; open it in a browser")));
  const std::string page = ReadFile(file);
  EXPECT_LT(page.size(), 10'000'000U);
  EXPECT_THAT(page.substr(0, page.find("The 3-D view of ofm-slam")),
              AllOf(StartsWith("<!DOCTYPE html>"), HasSubstr("ATE, RMSE"),
                    HasSubstr("Ground truth: <code>"), HasSubstr("data:image/jpeg;base64,"),
                    HasSubstr("% masked"), HasSubstr("CPU time of each frame")));
  // Nothing but people is masked in this recording.
  EXPECT_EQ(page.find("class=\"missing"), page.find("class=\"missing\">out: no object was found"));
  EXPECT_EQ(page.find("class=\"missing"), page.rfind("class=\"missing"));
}

TEST_F(ReportCommand, ComparesRunsAndTakesAGroundTruth) {
  const auto copy = File("copy");
  std::filesystem::copy(recording_->output(), copy, std::filesystem::copy_options::recursive);
  std::filesystem::remove(copy / "summary.json");
  const ProgramResult result = RunProgram(
      "report " + Out() + " " + copy.string() + " --output " + File("both.html").string() +
      " --ground-truth '" + (recording_->folder() / "groundtruth.txt").string() + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(ReadFile(File("both.html")).substr(0, 100000),
              AllOf(HasSubstr("out, copy"), HasSubstr("All runs side by side"),
                    HasSubstr("copy: has no summary.json")));
}

TEST_F(ReportCommand, DrawsEveryKindAsSvg) {
  for (const char* kind : {"plan", "xyz", "ate", "rpe", "timing", "culled", "map"}) {
    const std::string arguments =
        "plot " + Out() + " --kind " + kind + " --output " + File("p.svg").string();
    const ProgramResult result = RunProgram(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, File("p.svg").string() + "\n");
    EXPECT_THAT(ReadFile(File("p.svg")), AllOf(StartsWith("<svg"), HasSubstr("run0"))) << kind;
  }
}

TEST_F(ReportCommand, DrawsPng) {
  ASSERT_EQ(RunProgram("plot " + Out() + " -k ate -o " + File("p.png").string() + " --width 700")
                .exit_code,
            0);
  const cv::Mat picture = cv::imread(File("p.png").string(), cv::IMREAD_COLOR);
  ASSERT_EQ(picture.cols, 700);
  EXPECT_GT(picture.rows, 300);
  cv::Scalar mean, deviation;
  cv::meanStdDev(picture, mean, deviation);
  EXPECT_GT(mean[0], 200) << "white ground";
  EXPECT_GT(deviation[0], 10) << "something is drawn";
  EXPECT_GT(deviation[2], deviation[0]) << "the first run is blue";
}

TEST_F(ReportCommand, RendersCloudAndOctreeOfRunsSideBySide) {
  const std::string both = "render " + Out() + " " + Out() + " --width 200 --what cloud octree -o ";
  const ProgramResult result = RunProgram(both + File("map.png").string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, File("map.png").string() + "\n");
  const cv::Mat picture = cv::imread(File("map.png").string(), cv::IMREAD_COLOR);
  ASSERT_EQ(picture.cols, 2 * 200);
  ASSERT_EQ(picture.rows % 2, 0);
  for (const int row : {0, picture.rows / 2}) {
    const cv::Mat tile = picture(cv::Rect(0, row + 40, 200, picture.rows / 2 - 40));
    EXPECT_GT(cv::mean(tile.reshape(1) != 255)[0], 255 * .1) << "much of it is drawn";
    EXPECT_EQ(cv::norm(tile, picture(cv::Rect(200, row + 40, 200, tile.rows))), 0)
        << "the same run";
  }
  ASSERT_EQ(RunProgram(both + File("label.png").string() + " --color label").exit_code, 0);
  EXPECT_NE(ReadFile(File("label.png")), ReadFile(File("map.png")));
}

TEST_F(ReportCommand, BadInputIsOneErrorLine) {
  ExpectError("report", "OUT is required");
  ExpectError("report /nowhere", "/nowhere: is no folder; name one that ofm-slam run has written");
  ExpectError("report " + folder_.path().string(), "has no trajectory.txt");
  ExpectError("report " + Out() + " --ground-truth /nowhere.txt", "/nowhere.txt: does not exist");
  const auto truth = folder_.Write("truth.txt", "1 0 0 0 0 0 0 1\n2 0 0 x 0 0 0 1\n").string();
  ExpectError("report " + Out() + " --ground-truth " + truth, "truth.txt:2: 'x'");
  ExpectError("report " + Out() + " --output /nowhere/report.html", "/nowhere/report.html");
  ExpectError("plot " + Out() + " --output plan.pdf", "plan.pdf: name a file that ends in .svg");
  ExpectError("plot " + Out() + " --kind pie --output p.svg", "pie");
  ExpectError("plot " + Out() + " --kind plan", "--output");
  ExpectError("render " + Out() + " --output map.jpg", "map.jpg: name a file that ends in .png");
  ExpectError("render " + Out() + " --output /nowhere/map.png", "/nowhere/map.png");
  ExpectError("render " + Out() + " --what pie -o p.png", "pie");
}

TEST_F(ReportCommand, ADamagedResultIsNamedWithItsLine) {
  const auto copy = File("copy");
  std::filesystem::copy(recording_->output(), copy, std::filesystem::copy_options::recursive);
  folder_.Write("copy/frames.csv", "stamp,status\n1,2,3\n");
  ExpectError("report " + copy.string(), "frames.csv:2: ");
}

TEST_F(ReportCommand, APlotWithoutItsDataSaysHowToGetIt) {
  const auto copy = File("copy");
  std::filesystem::copy(recording_->output(), copy, std::filesystem::copy_options::recursive);
  for (const char* file : {"summary.json", "frames.csv", "map.ot"}) {
    std::filesystem::remove(copy / file);
  }
  const std::string plot = "plot " + copy.string() + " --output " + File("p.svg").string();
  ExpectError(plot + " --kind ate", "--ground-truth");
  ExpectError(plot + " --kind culled", "has no frames.csv");
  EXPECT_FALSE(std::filesystem::exists(File("p.svg")));
  ExpectError("render " + copy.string() + " --what octree -o " + File("p.png").string(),
              "has no map.ot; run with --set build_semantic_map=true");
}

TEST(Report, HelpGivesExamples) {
  EXPECT_THAT(RunProgram("report --help").out,
              AllOf(HasSubstr("--ground-truth"), HasSubstr("Examples:\n  ofm-slam report out\n")));
  EXPECT_THAT(RunProgram("render --help").out,
              AllOf(HasSubstr("--what"), HasSubstr("Examples:\n")));
  EXPECT_THAT(RunProgram("plot --help").out, AllOf(HasSubstr("--kind"), HasSubstr("Examples:\n")));
}

}  // namespace
}  // namespace ofm
