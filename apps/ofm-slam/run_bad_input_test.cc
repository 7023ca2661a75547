// Whatever is wrong with the input: one clear line, an exit code, and nothing spoilt.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "ofm/perception/test_support.h"
#include "test_recording.h"

namespace ofm {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// A run that must fail before it begins: nothing is written, and what lay there is untouched.
void ExpectRefused(const TestRecording& recording, const std::string& more,
                   const testing::Matcher<std::string>& message) {
  std::filesystem::create_directories(recording.output());
  std::ofstream(recording.output() / "trajectory.txt") << "of an earlier run";
  const ProgramResult result = recording.Run(more);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, IsOneErrorLine());
  EXPECT_THAT(result.err, message);
  EXPECT_EQ(ReadFile(recording.output() / "trajectory.txt"), "of an earlier run");
  EXPECT_FALSE(std::filesystem::exists(recording.output() / "summary.json"));
}

/// A run whose frame `frames` cannot be read: the results of those before it are there.
void ExpectEndsAfter(const TestRecording& recording, std::size_t frames,
                     const testing::Matcher<std::string>& message, const std::string& more = "") {
  const ProgramResult result = recording.Run(more);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, IsOneErrorLine());
  EXPECT_THAT(result.err, AllOf(message, HasSubstr("results up to there are in " +
                                                   recording.output().string())));
  EXPECT_EQ(CountPoses(recording.output() / "trajectory.txt"), frames);
  EXPECT_EQ(CountPoses(recording.output() / "trajectory_live.txt"), frames);
  for (const char* name : {"keyframes.txt", "map.ply", "map.ot", "map.bt", "config.yaml"}) {
    EXPECT_TRUE(std::filesystem::exists(recording.output() / name)) << name;
  }
  const auto summary = nlohmann::json::parse(ReadFile(recording.output() / "summary.json"));
  EXPECT_EQ(summary["counts"]["frames_tracked"], frames);
  EXPECT_THAT(summary["error"].get<std::string>(), message);
}

void Truncate(const std::filesystem::path& file) {
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
}

TEST(RunOnBadInput, MissingFolder) {
  const ProgramResult result = RunProgram("run /no/such/desk --camera tum-fr1 --output /tmp/never");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err,
            "ofm-slam: error: /no/such/desk: does not exist; name a TUM RGB-D folder\n");
  EXPECT_FALSE(std::filesystem::exists("/tmp/never"));
}

TEST(RunOnBadInput, NoSequenceNamed) {
  const ProgramResult result = RunProgram("run");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(IsOneErrorLine(), HasSubstr("SEQUENCE")));
}

TEST(RunOnBadInput, EmptyList) {
  const TestRecording recording(2);
  recording.RemoveAssociations();
  recording.Write("rgb.txt", "# timestamp filename\n");
  ExpectRefused(recording, "", HasSubstr("sequence/rgb.txt: lists no image"));
}

TEST(RunOnBadInput, ListThatNamesAMissingFile) {
  const TestRecording recording(4);
  std::filesystem::remove(recording.ColorImage(2));
  ExpectRefused(recording, "",
                AllOf(HasSubstr("associations.txt:3: "), HasSubstr(".png: does not exist")));
}

TEST(RunOnBadInput, TruncatedColourImage) {
  const TestRecording recording(24);
  Truncate(recording.ColorImage(20));
  ExpectEndsAfter(recording, 20,
                  AllOf(HasSubstr("associations.txt:21: "),
                        HasSubstr(recording.ColorImage(20).filename().string())));
}

TEST(RunOnBadInput, TruncatedDepthImageInAThreadedRun) {
  const TestRecording recording(9);
  Truncate(recording.DepthImage(7));
  ExpectEndsAfter(
      recording, 7,
      AllOf(HasSubstr("associations.txt:8: "), HasSubstr(recording.DepthImage(7).string())),
      "--threaded");
}

TEST(RunOnBadInput, TruncatedFirstImageSpoilsNothing) {
  const TestRecording recording(3);
  Truncate(recording.ColorImage(0));
  ExpectRefused(recording, "", HasSubstr("associations.txt:1: "));
}

TEST(RunOnBadInput, CameraOfAnotherImageSize) {
  const TestRecording recording(3);
  ExpectRefused(
      recording, "--camera tum-fr1",
      AllOf(HasSubstr("associations.txt:1: "), HasSubstr("is 240x180, but the camera is 640x480"),
            HasSubstr("choose the right camera")));
}

TEST(RunOnBadInput, OneImageOfAnotherSize) {
  const TestRecording recording(6);
  ASSERT_TRUE(cv::imwrite(recording.ColorImage(4).string(), cv::Mat(180, 241, CV_8UC3)));
  ExpectEndsAfter(recording, 4, HasSubstr("is 241x180, but the camera is 240x180"));
}

TEST(RunOnBadInput, DepthOfTheWrongType) {
  const TestRecording recording(3);
  ASSERT_TRUE(cv::imwrite(recording.DepthImage(0).string(), cv::Mat(180, 240, CV_8UC1)));
  ExpectRefused(
      recording, "",
      AllOf(HasSubstr("associations.txt:1: "), HasSubstr("must have 1 channel of 16 bits")));
}

TEST(RunOnBadInput, UnsortedTimes) {
  const TestRecording recording(3);
  recording.RemoveAssociations();
  recording.Write("rgb.txt", "1000.1 rgb/a.png\n1000.0 rgb/b.png\n");
  ExpectRefused(recording, "", HasSubstr("sequence/rgb.txt:2: "));
}

TEST(RunOnBadInput, NanInAList) {
  const TestRecording recording(3);
  recording.RemoveAssociations();
  recording.Write("depth.txt", "1000.0 depth/a.png\nnan depth/b.png\n");
  ExpectRefused(recording, "", HasSubstr("sequence/depth.txt:2: "));
}

TEST(RunOnBadInput, NanInTheGroundTruth) {
  const TestRecording recording(3);
  recording.Write("groundtruth.txt", "# truth\n1000 0 nan 0 0 0 0 1\n");
  ExpectRefused(recording, "", HasSubstr("sequence/groundtruth.txt:2: "));
}

TEST(RunOnBadInput, NanInTheCamera) {
  const TestRecording recording(2);
  recording.Write("camera.yaml", "width: 240\nheight: 180\nfx: .nan\n");
  ExpectRefused(recording, "--camera " + (recording.folder() / "camera.yaml").string(),
                HasSubstr("camera.yaml:3: "));
}

TEST(RunOnBadInput, UnknownKeyInAConfiguration) {
  const TestRecording recording(2);
  recording.Write("my.yaml", "features:\n  count: 500\n  colour: red\n");
  ExpectRefused(recording, "--config " + (recording.folder() / "my.yaml").string(),
                AllOf(HasSubstr("my.yaml:3: "), HasSubstr("colour")));
}

TEST(RunOnBadInput, ValueOutOfRangeInAConfiguration) {
  const TestRecording recording(2);
  recording.Write("my.yaml", "features:\n  count: 3\n");
  ExpectRefused(recording, "--config " + (recording.folder() / "my.yaml").string(),
                AllOf(HasSubstr("my.yaml:2: "), HasSubstr("count")));
}

TEST(RunOnBadInput, ConfigurationThatIsMissing) {
  const TestRecording recording(2);
  ExpectRefused(recording, "--config /no/my.yaml", HasSubstr("/no/my.yaml: "));
}

TEST(RunOnBadInput, ModelThatIsNoNetwork) {
  const TestRecording recording(2);
  recording.Write("model.onnx", "this is no network");
  const std::string model = (recording.folder() / "model.onnx").string();
  ExpectRefused(recording, "--segmenter yolo-seg --model " + model, HasSubstr(model + ": "));
}

TEST(RunOnBadInput, ModelThatOpenCvCannotLoad) {
  const TestRecording recording(2);
  const test::Message graph = test::Message()
                                  .Add(1, test::OnnxNode("NoSuchOperation", {"images"}, "output"))
                                  .Add(11, test::OnnxValue("images", {1, 3, 32, 32}))
                                  .Add(12, test::OnnxValue("output", {1, 3, 32, 32}));
  recording.Write("model.onnx", test::OnnxModel(graph));
  const std::string model = (recording.folder() / "model.onnx").string();
  ExpectRefused(recording, "--segmenter yolo-seg --model " + model,
                HasSubstr(model + ": OpenCV cannot load this network"));
}

TEST(RunOnBadInput, ModelThatIsMissing) {
  const TestRecording recording(2);
  ExpectRefused(recording, "--segmenter yolo-seg --model /no/net.onnx",
                HasSubstr("/no/net.onnx: "));
  ExpectRefused(recording, "--segmenter yolo-seg", HasSubstr("model"));
}

TEST(RunOnBadInput, MasksThatAreMissing) {
  const TestRecording recording(4);
  std::filesystem::remove(recording.folder() / "mask" / recording.ColorImage(2).filename());
  ExpectEndsAfter(recording, 2, HasSubstr(": no mask for this frame"), "--segmenter masks");
  std::filesystem::remove_all(recording.folder() / "mask");
  std::filesystem::remove_all(recording.output());
  ExpectRefused(recording, "--segmenter masks", HasSubstr("mask: no such folder"));
}

TEST(RunOnBadInput, OutputThatCannotBeWritten) {
  const TestRecording recording(2);
  std::ofstream(recording.output()) << "a file is in the way";
  ProgramResult result = recording.Run();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(IsOneErrorLine(), HasSubstr(recording.output().string() + ": "),
                                HasSubstr("--output")));
  EXPECT_EQ(ReadFile(recording.output()), "a file is in the way");
}

TEST(RunOnBadInput, StartBehindTheEnd) {
  const TestRecording recording(2);
  ExpectRefused(recording, "--start 2", HasSubstr("has 2 frames"));
}

TEST(RunOnBadInput, WrongSettingsNameTheAssignment) {
  const TestRecording recording(2);
  for (const char* assignment :
       {"nonsense=1", "features.colour=red", "features.count=many", "features.count=0",
        "features.count", "dynamics.mode=sometimes", "dense.resolution_m=nan"}) {
    ExpectRefused(recording, std::string("--set ") + assignment, HasSubstr(assignment));
  }
  ExpectRefused(recording, "--segmenter eyes", HasSubstr("perception.segmenter=eyes"));
  ExpectRefused(recording, "--camera eyes", HasSubstr("'eyes' is neither"));
  ExpectRefused(recording, "--seed x", HasSubstr("--seed"));
  ExpectRefused(recording, "--frames -1", HasSubstr("--frames"));
}

}  // namespace
}  // namespace ofm
