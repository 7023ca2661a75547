#include "ofm/perception/make_segmenter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "ofm/io/test_folder.h"
#include "ofm/perception/mask_rcnn_test_support.h"
#include "ofm/perception/onnx_runtime_network.h"

namespace ofm {
namespace {

using ::testing::AllOf;
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

TEST(MakeSegmenter, MaskRcnnTakesTheTextGraphBesideTheGraphOrTheOneNamed) {
  const TestFolder folder;
  const test::TensorflowNetwork network = test::MakeTensorflowMaskRcnn();
  PerceptionOptions options{.segmenter = SegmenterKind::kMaskRcnn,
                            .model = folder.Write("net.pb", network.graph),
                            .input_width = 64,
                            .input_height = 32};
  EXPECT_THAT(ErrorOf([&] { MakeSegmenter(options, ""); }),
              AllOf(HasSubstr("net.pbtxt: does not exist"), HasSubstr("perception.model_graph")));
  const auto frame = test::MakeFrame(cv::Mat(32, 64, CV_8UC3, cv::Scalar(255, 0, 128)));
  Set(options, "model_graph=" + folder.Write("other.pbtxt", network.text_graph).string());
  const auto named = MakeSegmenter(options, "")->Segment(frame).instances;
  ASSERT_FALSE(named.empty());
  EXPECT_EQ(named[0].class_id, ClassId(0));
  Set(options, "model_graph=");
  folder.Write("net.pbtxt", network.text_graph);
  EXPECT_EQ(MakeSegmenter(options, "")->Segment(frame).instances.size(), named.size());
}

TEST(MakeSegmenter, MaskRcnnTakesThresholdsAndNamesFromTheOptions) {
  const TestFolder folder;
  const test::TensorflowNetwork network = test::MakeTensorflowMaskRcnn(2);
  PerceptionOptions options{.segmenter = SegmenterKind::kMaskRcnn,
                            .model = folder.Write("net.pb", network.graph),
                            .model_graph = folder.Write("net.pbtxt", network.text_graph),
                            .class_names_file = folder.Write("names.txt", "red\ngreen\n"),
                            .input_width = 64,
                            .input_height = 32};
  const auto frame = test::MakeFrame(cv::Mat(32, 64, CV_8UC3, cv::Scalar(255, 0, 128)));
  const auto count = [&] { return MakeSegmenter(options, "")->Segment(frame).instances.size(); };
  EXPECT_THAT(MakeSegmenter(options, "")->class_names(), SizeIs(2));
  EXPECT_GT(count(), 0U);
  for (const char* assignment : {"score_threshold=0.6", "mask_threshold=1", "min_area_px=2000"}) {
    PerceptionOptions changed = options;
    std::swap(changed, options);
    Set(options, assignment);
    EXPECT_EQ(count(), 0U) << assignment;
    std::swap(changed, options);
  }
}

TEST(MakeSegmenter, MaskRcnnInOnnxGoesThroughOnnxRuntime) {
  const TestFolder folder;
  const PerceptionOptions options{.segmenter = SegmenterKind::kMaskRcnn,
                                  .model = folder.Write("net.onnx", test::MakeOnnxMaskRcnn())};
  const auto frame = test::MakeFrame(cv::Mat(32, 64, CV_8UC3, cv::Scalar(255, 0, 128)));
  if (OnnxRuntimeNetwork::IsAvailable()) {
    EXPECT_THAT(MakeSegmenter(options, "")->Segment(frame).instances, SizeIs(1));
  } else {
    EXPECT_THAT(ErrorOf([&] { MakeSegmenter(options, ""); }), HasSubstr("libonnxruntime-dev"));
  }
}

TEST(MakeSegmenter, MaskRcnnNeedsAModelOfAKnownKind) {
  PerceptionOptions options{.segmenter = SegmenterKind::kMaskRcnn};
  EXPECT_THAT(ErrorOf([&] { MakeSegmenter(options, ""); }), HasSubstr("perception.model"));
  options.model = "weights.h5";
  EXPECT_THAT(ErrorOf([&] { MakeSegmenter(options, ""); }),
              HasSubstr("weights.h5: is neither a TensorFlow graph (.pb) nor an ONNX file"));
}

TEST(MakeSegmenter, UnknownSegmenterIsToldWithTheKnownOnes) {
  PerceptionOptions options;
  EXPECT_THAT(ErrorOf([&] { Set(options, "segmenter=yolo"); }),
              HasSubstr("none | masks | yolo-seg | mask-rcnn"));
}

}  // namespace
}  // namespace ofm
