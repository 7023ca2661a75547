#include "ofm/perception/make_segmenter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "ofm/io/test_folder.h"
#include "ofm/perception/test_support.h"

namespace ofm {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

void Set(PerceptionOptions& options, const std::string& assignment) {
  ApplyOptionAssignment(assignment, OptionFields(options));
}

TEST(MakeSegmenter, NoneSeesNothing) {
  const auto segmenter = MakeSegmenter({}, "/no/such/sequence");
  const auto frame = test::MakeFrame(cv::Mat::zeros(8, 8, CV_8UC3));
  EXPECT_THAT(segmenter->Segment(frame).instances, IsEmpty());
  EXPECT_EQ(segmenter->Segment(frame).frame_id, frame.id);
  EXPECT_THAT(segmenter->class_names(), IsEmpty());
}

TEST(MakeSegmenter, MasksAreBesideTheSequenceUnlessSaidOtherwise) {
  const TestFolder sequence, elsewhere;
  std::filesystem::create_directory(sequence.path() / "mask");
  cv::imwrite((sequence.path() / "mask/1.5.png").string(), cv::Mat(8, 8, CV_8UC1, cv::Scalar(1)));
  cv::imwrite((elsewhere.path() / "1.5.png").string(), cv::Mat::zeros(8, 8, CV_8UC1));
  const auto frame = test::MakeFrame(cv::Mat::zeros(8, 8, CV_8UC3), "1.5");
  PerceptionOptions options;
  Set(options, "segmenter=masks");
  const auto beside = MakeSegmenter(options, sequence.path());
  const auto instances = beside->Segment(frame).instances;
  ASSERT_THAT(instances, SizeIs(1));
  EXPECT_EQ(beside->class_names().at(instances[0].class_id.value), "person");
  Set(options, "masks_folder=" + elsewhere.path().string());
  EXPECT_THAT(MakeSegmenter(options, sequence.path())->Segment(frame).instances, IsEmpty());
}

TEST(MakeSegmenter, MissingMaskFolderIsNamed) {
  EXPECT_THAT(
      ErrorOf([] { MakeSegmenter({.segmenter = SegmenterKind::kMasks}, "/no/such/sequence"); }),
      HasSubstr("/no/such/sequence/mask: no such folder"));
}

TEST(MakeSegmenter, YoloTakesModelClassesAndThresholdFromTheOptions) {
  const TestFolder folder;
  PerceptionOptions options;
  Set(options, "segmenter=yolo-seg");
  Set(options, "model=" + folder.Write("net.onnx", test::MakeYoloNetwork()).string());
  Set(options, "class_names_file=" + folder.Write("names.txt", "red\ngreen\n").string());
  const auto frame = test::MakeFrame(cv::Mat(32, 64, CV_8UC3, cv::Scalar(255, 0, 128)));
  const auto segmenter = MakeSegmenter(options, "");
  EXPECT_THAT(segmenter->class_names(), SizeIs(2));
  EXPECT_THAT(segmenter->Segment(frame).instances, SizeIs(1));
  Set(options, "score_threshold=0.6");
  EXPECT_THAT(MakeSegmenter(options, "")->Segment(frame).instances, IsEmpty());
}

TEST(MakeSegmenter, YoloNeedsAModelAndBothSidesOfTheInput) {
  PerceptionOptions options{.segmenter = SegmenterKind::kYoloSeg};
  EXPECT_THAT(ErrorOf([&] { MakeSegmenter(options, ""); }), HasSubstr("perception.model"));
  options.input_width = 64;
  EXPECT_THAT(ErrorOf([&] { MakeSegmenter(options, ""); }), HasSubstr("set together"));
}

TEST(MakeSegmenter, UnknownSegmenterIsToldWithTheKnownOnes) {
  PerceptionOptions options;
  EXPECT_THAT(ErrorOf([&] { Set(options, "segmenter=yolo"); }),
              HasSubstr("none | masks | yolo-seg"));
}

}  // namespace
}  // namespace ofm
