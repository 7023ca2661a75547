// ofm-slam vocabulary, on a small simulated recording.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/features/vocabulary_file.h"
#include "test_recording.h"

namespace ofm {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// As an argument of the shell, with a blank after it.
std::string Quoted(const std::filesystem::path& path) {
  std::string quoted = "'";
  quoted += path.string();
  quoted += "' ";
  return quoted;
}

class VocabularyCommand : public testing::Test {
 protected:
  ProgramResult Train(const std::string& arguments) const {
    return RunProgram("vocabulary train --features 200 --output " + Quoted(file()) + arguments);
  }
  std::string file() const { return (folder_.path() / "my.voc").string(); }

  static const TestRecording& recording() {
    static const TestRecording recording(6);
    return recording;
  }
  static std::string rgb() { return Quoted(recording().folder() / "rgb"); }

  TestFolder folder_;
};

TEST_F(VocabularyCommand, TrainsOnAFolderOfImages) {
  const ProgramResult result = Train(rgb() + "--branching 5 --depth 2");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("25 words, 31 nodes, up to 5 children, 2 levels"),
                                HasSubstr("from 6 images, in " + file())));
  EXPECT_THAT(result.err, AllOf(HasSubstr("[####################] 100 % features of the images"),
                                HasSubstr("[####################] 100 % words")));
  EXPECT_EQ(LoadVocabulary(file()).word_count(), 25U);
}

TEST_F(VocabularyCommand, GivesTheSameFileForTheSameSeed) {
  ASSERT_EQ(Train(rgb() + "--quiet").exit_code, 0);
  const std::string first = ReadFile(file());
  const ProgramResult again = Train(rgb() + "--quiet");
  EXPECT_THAT(again.err, IsEmpty());
  EXPECT_EQ(ReadFile(file()), first);
  ASSERT_EQ(Train(rgb() + "--quiet --seed 2").exit_code, 0);
  EXPECT_NE(ReadFile(file()), first);
}

TEST_F(VocabularyCommand, TakesEachNthOfFoldersAndFiles) {
  const std::string image = Quoted(recording().ColorImage(0));
  EXPECT_THAT(Train("--quiet --step 3 " + image + rgb()).out, HasSubstr("from 3 images"));
}

TEST_F(VocabularyCommand, BadImagesAreErrorsAndLeaveNoFile) {
  EXPECT_THAT(Train("--quiet /no/such.png").err,
              AllOf(IsOneErrorLine(), HasSubstr("/no/such.png: does not exist")));
  const std::string broken = Quoted(folder_.Write("broken/image.png", "no image").parent_path());
  EXPECT_THAT(Train("--quiet " + rgb() + broken).err,
              AllOf(IsOneErrorLine(), HasSubstr("broken/image.png")));
  EXPECT_THAT(Train("--quiet " + Quoted(folder_.path())).err,
              AllOf(IsOneErrorLine(), HasSubstr("has no PNG or JPEG files")));
  EXPECT_FALSE(std::filesystem::exists(file()));
}

TEST_F(VocabularyCommand, InterruptLeavesNoFile) {
  // As Ctrl-C does in the middle of the images.
  std::string images;
  for (int i = 0; i < 60; ++i) images += rgb();
  const std::string log = (folder_.path() / "log").string();
  // As Ctrl-C does, once the first image is done.
  const ProgramResult result =
      RunProgram("vocabulary train --output " + Quoted(file()) + images + "2> " + Quoted(log) +
                 "& for i in $(seq 500); do grep -q features " + Quoted(log) +
                 "&& break; sleep 0.02; done; kill -TERM $!; wait $!");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(ReadFile(log), HasSubstr("ofm-slam: error: interrupted; no vocabulary was written"));
  EXPECT_FALSE(std::filesystem::exists(file()));
}

TEST_F(VocabularyCommand, ImportsDbow2TextAndDescribesIt) {
  std::string text = "10 1 0 0\n";
  for (const char* byte : {" 7", " 99"}) {
    text += "0 1";
    for (int i = 0; i < 32; ++i) text += byte;
    text += " 0.5\n";
  }
  folder_.Write("voc.txt", text);
  const std::string source = Quoted(folder_.path() / "voc.txt");
  const std::string import = "vocabulary import " + source + "--output " + Quoted(file());
  const ProgramResult result = RunProgram(import);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("2 words, 3 nodes, up to 2 children, 1 levels"));
  EXPECT_THAT(RunProgram("vocabulary info " + Quoted(file())).out, HasSubstr("2 words"));

  folder_.Write("voc.txt", text + "0 1 300\n");
  EXPECT_THAT(RunProgram(import).err,
              AllOf(IsOneErrorLine(), HasSubstr("voc.txt:4: descriptor byte must be")));
}

TEST(Vocabulary, InfoDescribesTheOneBuiltIn) {
  const ProgramResult result = RunProgram("vocabulary info");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr(" words, "), HasSubstr(" levels, ")));
}

TEST(Vocabulary, InfoOfAnotherFileIsAnError) {
  const TestFolder folder;
  const std::string file = Quoted(folder.Write("other.voc", "no vocabulary"));
  EXPECT_THAT(RunProgram("vocabulary info " + file).err,
              AllOf(IsOneErrorLine(), HasSubstr("other.voc: is not a vocabulary")));
}

TEST(Vocabulary, HelpTeachesWithExamples) {
  EXPECT_THAT(RunProgram("vocabulary --help").out,
              AllOf(HasSubstr("train"), HasSubstr("import"), HasSubstr("info"),
                    HasSubstr("ofm-slam vocabulary train office/rgb --output office.voc")));
  EXPECT_THAT(RunProgram("vocabulary train --help").out,
              AllOf(HasSubstr("IMAGES"), HasSubstr("--step"), HasSubstr("--branching")));
  EXPECT_THAT(RunProgram("vocabulary").err, IsOneErrorLine());
}

}  // namespace
}  // namespace ofm
