#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_recording.h"

namespace ofm {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(RunView, TellsItsAddressAndChangesNothing) {
  const TestRecording recording(8);
  ASSERT_EQ(recording.Run("--segmenter masks").exit_code, 0);
  const std::string without = ReadFile(recording.output() / "trajectory.txt");
  const ProgramResult result = recording.Run("--segmenter masks --view --view-port 0");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("live view at http://127.0.0.1:"));
  EXPECT_EQ(ReadFile(recording.output() / "trajectory.txt"), without);
}

TEST(RunView, WhatIsNoAddressIsAnErrorBeforeTheRun) {
  const TestRecording recording(3);
  const ProgramResult result = recording.Run("--view --view-address nowhere");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("\"nowhere\""), HasSubstr("127.0.0.1")));
  EXPECT_FALSE(std::filesystem::exists(recording.output() / "trajectory.txt"));
}

TEST(RunView, APortNeedsTheView) {
  const ProgramResult result = RunProgram("run somewhere --view-port 80");
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("--view"));
}

}  // namespace
}  // namespace ofm
