#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_recording.h"

namespace ofm {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Program, PrintsItsVersion) {
  const ProgramResult result = RunProgram("--version");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "ofm-slam " OFM_VERSION "\n");
  EXPECT_THAT(result.err, IsEmpty());
}

TEST(Program, HelpNamesTheCommandsAndGivesExamples) {
  const ProgramResult result = RunProgram("--help");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("run"), HasSubstr("evaluate"), HasSubstr("demo"),
                                HasSubstr("--version"), HasSubstr("Examples:\n  ofm-slam demo\n")));
}

TEST(Program, UsageErrorsAreOneLine) {
  for (const char* arguments : {"", "fly", "--nonsense", "evaluate", "evaluate a", "evaluate a b c",
                                "evaluate a b --frames x", "evaluate a b --max-difference -1",
                                "evaluate a b --frames 3 --sequence c"}) {
    const ProgramResult result = RunProgram(arguments);
    EXPECT_EQ(result.exit_code, 1) << arguments;
    EXPECT_THAT(result.out, IsEmpty()) << arguments;
    EXPECT_THAT(result.err, IsOneErrorLine()) << arguments;
    EXPECT_THAT(result.err, HasSubstr("see ofm-slam --help")) << arguments;
  }
}

TEST(Program, NamesWhatItDoesNotKnow) {
  EXPECT_THAT(RunProgram("fly").err, HasSubstr("fly"));
  EXPECT_THAT(RunProgram("").err, HasSubstr("A subcommand is required"));
}

TEST(Program, ErrorsAreOneLineThatNamesTheFile) {
  const ProgramResult result = RunProgram("evaluate /no/estimate.txt /no/groundtruth.txt");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_EQ(result.err, "ofm-slam: error: /no/estimate.txt: does not exist; check the path\n");
}

TEST(Program, ReportsAnOutputThatCannotBeWritten) {
  if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const ProgramResult result = RunProgram("evaluate --help > /dev/full");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "ofm-slam: error: the output cannot be written\n");
}

}  // namespace
}  // namespace ofm
