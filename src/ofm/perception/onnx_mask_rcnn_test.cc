// Small networks in the layouts of torchvision and of the ONNX model zoo, run by ONNX Runtime. In a
// build without it they are skipped; what it gives is read by functions tested elsewhere.
#include "ofm/perception/onnx_mask_rcnn.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "ofm/io/test_folder.h"
#include "ofm/perception/mask_rcnn_test_support.h"

namespace ofm {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

class OnnxMaskRcnnFile : public ::testing::Test {
 protected:
  std::filesystem::path Write(const test::OnnxMaskRcnnNetwork& network = {}) const {
    return folder_.Write("net.onnx", test::MakeOnnxMaskRcnn(network));
  }
  std::string LoadError(const test::OnnxMaskRcnnNetwork& network, cv::Size input = {}) const {
    const auto path = Write(network);
    return ErrorOf([&] { OnnxMaskRcnn(path, input); });
  }

  TestFolder folder_;
};

class RunByOnnxRuntime : public OnnxMaskRcnnFile {
 protected:
  void SetUp() override {
    if (!OnnxRuntimeNetwork::IsAvailable()) GTEST_SKIP() << "built without ONNX Runtime";
  }
};

/// Of a mean over 2048 pixels in single precision, in whatever order they are added.
constexpr double kMeanTolerance = 1e-5;

/// The mean red is 0.4; the left half is blue.
cv::Mat HalfBlue() {
  cv::Mat image(32, 64, CV_8UC3, cv::Scalar(0, 0, 102));
  image(cv::Rect(0, 0, 32, 32)).setTo(cv::Scalar(255, 0, 102));
  return image;
}

TEST_F(RunByOnnxRuntime, TorchvisionGetsRedGreenBlueBetweenZeroAndOne) {
  OnnxMaskRcnn network(Write(), {});
  EXPECT_EQ(network.exporter(), MaskRcnnExport::kTorchvision);
  const auto detections = network.Detect(HalfBlue(), network.Fit({64, 32}));
  ASSERT_THAT(detections, SizeIs(1));
  EXPECT_NEAR(detections[0].score, 0.4F, kMeanTolerance);
  EXPECT_EQ(detections[0].label, 62);
  EXPECT_EQ(detections[0].box, cv::Rect2d(8, 4, 32, 20));
  ASSERT_EQ(detections[0].mask.size(), cv::Size(64, 32));
  EXPECT_GT(detections[0].mask.at<float>(31, 31), 0.99F);
  EXPECT_LT(detections[0].mask.at<float>(31, 32), 0.01F);
}

TEST_F(RunByOnnxRuntime, TorchvisionScalesItself) {
  const OnnxMaskRcnn network(Write(), {});
  const Letterbox letterbox = network.Fit({641, 479});
  EXPECT_EQ(letterbox.input, cv::Size(641, 479));
  EXPECT_EQ(letterbox.resized, cv::Size(641, 479));
  EXPECT_EQ(FindClassOfLabel(network.MapToCoco(), 62), ClassId(56));  // chair of 91
}

TEST_F(RunByOnnxRuntime, ZooGetsBlueGreenRedLessItsMean) {
  OnnxMaskRcnn network(Write({.masks = test::MaskSize::kBox}), {64, 32});
  EXPECT_EQ(network.exporter(), MaskRcnnExport::kModelZoo);
  const auto detections = network.Detect(HalfBlue(), network.Fit({64, 32}));
  ASSERT_THAT(detections, SizeIs(1));
  EXPECT_NEAR(detections[0].score, 127.5F - 102.9801F, 1e-3);
  EXPECT_EQ(detections[0].box, cv::Rect2d(8, 4, 33, 21));
  EXPECT_EQ(detections[0].mask.size(), cv::Size(28, 28));
  EXPECT_EQ(FindClassOfLabel(network.MapToCoco(), 62), ClassId(61));  // toilet of 80
}

TEST_F(RunByOnnxRuntime, ZooScalesToEightHundredAndPadsToThirtyTwo) {
  const OnnxMaskRcnn network(Write({.masks = test::MaskSize::kBox}), {});
  const Letterbox letterbox = network.Fit({640, 480});
  EXPECT_EQ(letterbox.resized, cv::Size(1067, 800));
  EXPECT_EQ(letterbox.input, cv::Size(1088, 800));
  EXPECT_EQ(network.Fit({480, 640}).input, cv::Size(736, 960));
}

TEST_F(RunByOnnxRuntime, BatchOfOneIsTakenToo) {
  OnnxMaskRcnn network(Write({.input_shape = {1, 3, 32, 64}}), {});
  EXPECT_EQ(network.Fit({640, 480}).input, cv::Size(64, 32));
  EXPECT_EQ(network.Fit({640, 480}).resized, cv::Size(43, 32));
  EXPECT_NEAR(network.Detect(HalfBlue(), network.Fit({64, 32})).at(0).score, 0.4F, kMeanTolerance);
}

TEST_F(RunByOnnxRuntime, SizeOfTheFileStands) {
  EXPECT_THAT(LoadError({.input_shape = {3, 32, 64}}, {64, 64}),
              HasSubstr("net.onnx: takes images of 64 x 32 px only"));
  EXPECT_EQ(LoadError({.input_shape = {3, 32, 64}}, {64, 32}), "");
}

TEST_F(RunByOnnxRuntime, NetworksOfAnotherKindAreToldInOneLineAndNothingIsOnStderr) {
  ::testing::internal::CaptureStderr();
  const std::string no_masks = LoadError({.has_masks = false});
  const std::string grey = LoadError({.input_shape = {1, 0, 0}});
  const auto broken = folder_.Write(
      "broken.onnx",
      test::OnnxModel(test::Message()
                          .Add(1, test::OnnxNode("NoSuchOperation", {"image"}, "boxes"))
                          .Bytes(2, "odd")
                          .Add(11, test::OnnxValue("image", {3, 32, 32}))
                          .Add(12, test::OnnxValue("boxes", {1, 4}))));
  const std::string unknown = ErrorOf([&] { OnnxMaskRcnn(broken, {}); });
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(no_masks, AllOf(HasSubstr("net.onnx: the outputs ("), HasSubstr("labels 1 whole")));
  EXPECT_THAT(grey, HasSubstr("net.onnx: does not take one colour image"));
  EXPECT_THAT(unknown, AllOf(HasSubstr("broken.onnx: ONNX Runtime cannot load this network"),
                             Not(HasSubstr("\n"))));
}

TEST_F(RunByOnnxRuntime, FileThatEndsTooEarlyIsNamed) {
  std::string bytes = test::MakeOnnxMaskRcnn();
  bytes.resize(bytes.size() / 2);
  const auto path = folder_.Write("half.onnx", bytes);
  EXPECT_THAT(ErrorOf([&] { OnnxMaskRcnn(path, {}); }),
              HasSubstr("half.onnx: is no ONNX network or ends too early"));
}

TEST_F(RunByOnnxRuntime, SameImageGivesTheSameDetections) {
  OnnxMaskRcnn network(Write(), {});
  const cv::Mat first = network.Detect(HalfBlue(), network.Fit({64, 32})).at(0).mask.clone();
  const cv::Mat second = network.Detect(HalfBlue(), network.Fit({64, 32})).at(0).mask;
  EXPECT_EQ(cv::countNonZero(first != second), 0);
}

TEST_F(OnnxMaskRcnnFile, MissingFileIsNamedWithAndWithoutOnnxRuntime) {
  EXPECT_THAT(ErrorOf([] { OnnxMaskRcnn("/no/such.onnx", {}); }),
              HasSubstr("/no/such.onnx: does not exist"));
}

TEST_F(OnnxMaskRcnnFile, WithoutOnnxRuntimeTheErrorSaysHowToGetIt) {
  if (OnnxRuntimeNetwork::IsAvailable()) GTEST_SKIP() << "built with ONNX Runtime";
  EXPECT_THAT(LoadError({}), AllOf(HasSubstr("net.onnx: needs ONNX Runtime"),
                                   HasSubstr("libonnxruntime-dev"), Not(HasSubstr("\n"))));
}

}  // namespace
}  // namespace ofm
