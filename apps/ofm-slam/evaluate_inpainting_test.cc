#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <regex>

#include "ofm/io/camera_file.h"
#include "ofm/io/tum_sequence.h"
#include "test_recording.h"

namespace ofm {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// The number before a unit in a line of the output; -1 where there is none.
double NumberIn(const ProgramResult& result, const std::string& pattern) {
  std::smatch found;
  return std::regex_search(result.out, found, std::regex(pattern)) ? std::stod(found[1]) : -1;
}

class EvaluateInpaintingCommand : public testing::Test {
 protected:
  EvaluateInpaintingCommand() : recording_(20) {}

  std::filesystem::path filled() const { return recording_.root() / "filled"; }
  ProgramResult RunAndWrite(const std::string& more = "") const {
    return recording_.Run("--segmenter masks --write-inpainted '" + filled().string() + "' " +
                          more);
  }
  /// Against the recording itself: what it shows at the actors' pixels is the actors.
  ProgramResult Evaluate() const {
    const std::string folder = recording_.folder().string();
    return RunProgram("evaluate-inpainting '" + filled().string() + "' '" + folder + "/mask' '" +
                      folder + "'");
  }

  TestRecording recording_;
};

TEST_F(EvaluateInpaintingCommand, FillsHiddenPixelsWithWhatIsBehindThem) {
  ASSERT_EQ(RunAndWrite().exit_code, 0);
  const RgbdSequence sequence(filled(), LoadCamera(filled() / "camera.yaml"));
  EXPECT_EQ(sequence.size(), 20U) << "a folder that the program itself can read";
  const ProgramResult result = Evaluate();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GT(NumberIn(result, "\\(([0-9.]+) %\\)"), 5);
  EXPECT_GT(NumberIn(result, "error ([0-9.]+) mm"), 100) << "the person is not there any more";
}

TEST_F(EvaluateInpaintingCommand, BadInputIsOneLineThatNamesTheFile) {
  const ProgramResult missing = Evaluate();
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.out, IsEmpty());
  EXPECT_THAT(missing.err, AllOf(IsOneErrorLine(), HasSubstr((filled() / "camera.yaml").string())));
  ASSERT_EQ(RunAndWrite().exit_code, 0);
  std::filesystem::remove(recording_.folder() / "mask" /
                          recording_.ColorImage(3).filename().replace_extension(".png"));
  EXPECT_THAT(Evaluate().err, AllOf(IsOneErrorLine(), HasSubstr("mask")));
}

TEST_F(EvaluateInpaintingCommand, AFolderThatCannotBeMadeIsAnErrorBeforeTheRun) {
  recording_.Write("../filled", "a file in the way");
  const ProgramResult result = RunAndWrite();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(IsOneErrorLine(), HasSubstr(filled().string())));
}

}  // namespace
}  // namespace ofm
