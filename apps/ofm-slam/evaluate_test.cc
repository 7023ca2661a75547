#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.h"

namespace ofm {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A straight walk with a pose every 0.1 s, `offset_m` to the side.
std::string Walk(int count, double offset_m) {
  std::string text = "# made for a test\n";
  for (int i = 0; i < count; ++i) {
    const double side_m = i % 2 == 0 ? offset_m : -offset_m;
    text += std::to_string(100 + 0.1 * i) + " " + std::to_string(0.05 * i) + " " +
            std::to_string(side_m) + " 0 0 0 0 1\n";
  }
  return text;
}

class EvaluateCommand : public testing::Test {
 protected:
  EvaluateCommand() {
    folder_.Write("estimate.txt", Walk(40, 0.01));
    folder_.Write("groundtruth.txt", Walk(40, 0));
  }

  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }

  ProgramResult Evaluate(const std::string& more = "") const {
    return RunProgram("evaluate '" + Path("estimate.txt") + "' '" + Path("groundtruth.txt") + "' " +
                      more);
  }

  TestFolder folder_;
};

TEST_F(EvaluateCommand, PrintsATable) {
  const ProgramResult result = Evaluate();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(result.out, HasSubstr("ATE            translation [m]          40   0.0"));
  EXPECT_THAT(result.out, HasSubstr("RPE per frame  translation [m]          38   0.020000"));
  EXPECT_THAT(result.out, HasSubstr("rotation [deg]"));
  EXPECT_THAT(result.out, HasSubstr("RPE over 1 s"));
  EXPECT_THAT(result.out, HasSubstr("RPE all pairs"));
  EXPECT_THAT(result.out, Not(HasSubstr("coverage")));
}

TEST_F(EvaluateCommand, CountsTheCoverage) {
  EXPECT_THAT(Evaluate("--frames 50").out, EndsWith("coverage: 40 of 50 frames (80.0 %)\n"));
  // Frames from 99.5 s on; those from 100 s to 103.9 s have ground truth.
  std::string list;
  for (int i = 0; i < 100; ++i) {
    const std::string stamp = std::to_string(99.5 + 0.05 * i);
    list += stamp + " rgb/a.png " + stamp + " depth/a.png\n";
  }
  folder_.Write("sequence/associations.txt", list);
  EXPECT_THAT(Evaluate("--sequence '" + Path("sequence") + "'").out,
              EndsWith("coverage: 40 of 79 frames (50.6 %)\n"));
}

TEST_F(EvaluateCommand, ASequenceOfAnotherTimeIsAnError) {
  folder_.Write("sequence/associations.txt", "5 rgb/a.png 5 depth/a.png\n");
  const ProgramResult result = Evaluate("--sequence '" + Path("sequence") + "'");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "ofm-slam: error: " + Path("sequence") +
                            ": has no frame within the time of the ground truth\n");
}

TEST_F(EvaluateCommand, WritesJson) {
  const ProgramResult result = Evaluate("--json '" + Path("errors.json") + "' --frames 40");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(ReadFile(Path("errors.json")));
  EXPECT_EQ(json["estimate"], Path("estimate.txt"));
  EXPECT_EQ(json["ate"]["pairs"], 40);
  EXPECT_NEAR(json["rpe_per_frame"]["translation_m"]["rmse"].get<double>(), 0.02, 1e-12);
  EXPECT_EQ(json["coverage"]["ratio"], 1.0);
}

TEST_F(EvaluateCommand, AJsonThatCannotBeWrittenIsAnError) {
  const ProgramResult result = Evaluate("--json '" + Path("none/errors.json") + "'");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "ofm-slam: error: " + Path("none/errors.json") +
                            ": cannot be written: No such file or directory; create its folder "
                            "first\n");
}

TEST_F(EvaluateCommand, NamesTheLineOfABadPose) {
  folder_.Write("estimate.txt", "1 0 0 0 0 0 0 1\n2 0 nan 0 0 0 0 1\n");
  const ProgramResult result = Evaluate();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_EQ(result.err,
            "ofm-slam: error: " + Path("estimate.txt") + ":2: 'nan' is not a finite number\n");
}

TEST_F(EvaluateCommand, TrajectoriesOfDifferentTimesAreAnError) {
  folder_.Write("estimate.txt", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
  EXPECT_THAT(Evaluate().err, HasSubstr("0 of 2 estimated poses have one of 40 true poses"));
  folder_.Write("estimate.txt", "# nothing\n");
  EXPECT_EQ(Evaluate().err, "ofm-slam: error: " + Path("estimate.txt") + ": holds no pose\n");
  EXPECT_EQ(Evaluate().exit_code, 1);
}

TEST_F(EvaluateCommand, HelpExplainsTheMeasures) {
  const ProgramResult result = RunProgram("evaluate --help");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("ESTIMATE"));
  EXPECT_THAT(result.out, HasSubstr("--max-difference"));
  EXPECT_THAT(result.out, HasSubstr("Examples:\n"));
}

}  // namespace
}  // namespace ofm
