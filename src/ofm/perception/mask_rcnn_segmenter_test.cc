#include "ofm/perception/mask_rcnn_segmenter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "ofm/io/test_folder.h"
#include "ofm/perception/class_names.h"
#include "ofm/perception/mask_rcnn_test_support.h"
#include "ofm/perception/onnx_mask_rcnn.h"
#include "ofm/perception/tensorflow_mask_rcnn.h"

namespace ofm {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

MaskRcnnSegmenter MakeTensorflow(cv::Size input, const MaskRcnnDecoderOptions& options = {}) {
  const TestFolder folder;
  const test::TensorflowNetwork network = test::MakeTensorflowMaskRcnn();
  return {std::make_unique<TensorflowMaskRcnn>(
              TensorflowMaskRcnnModel{folder.Write("net.pb", network.graph),
                                      folder.Write("net.pbtxt", network.text_graph), input}),
          {},
          options};
}

/// The network's box is x 4 to 44, y 0 to 20 of the input; its mask is where the image is blue,
/// that is left of 32.
cv::Mat PersonImage() {
  cv::Mat image(32, 64, CV_8UC3, cv::Scalar(0, 0, 0));
  image(cv::Rect(0, 0, 32, 32)).setTo(cv::Scalar(255, 0, 0));
  image(cv::Rect(16, 0, 16, 16)).setTo(cv::Scalar(255, 0, 204));
  return image;
}

TEST(MaskRcnnSegmenter, TensorflowInstanceIsWhereTheNetworkSaysIt) {
  MaskRcnnSegmenter segmenter = MakeTensorflow({64, 32});
  const auto segmentation = segmenter.Segment(test::MakeFrame(PersonImage()));
  EXPECT_EQ(segmentation.frame_id, FrameId(7));
  ASSERT_THAT(segmentation.instances, SizeIs(1));
  const Instance& instance = segmentation.instances[0];
  EXPECT_EQ(segmenter.class_names().at(instance.class_id.value), "person");
  EXPECT_NEAR(instance.score, 0.8F, 1e-4);
  EXPECT_EQ(instance.box, cv::Rect(4, 0, 40, 20));
  cv::Mat expected = cv::Mat::zeros(32, 64, CV_8UC1);
  expected(cv::Rect(4, 0, 28, 20)) = 255;
  // The crop of 15 x 15 samples a feature map of 16 x 8: a column more or less at the mask's edge.
  cv::Mat strange = instance.mask != expected;
  strange(cv::Rect(30, 0, 4, 20)) = 0;
  EXPECT_EQ(cv::countNonZero(strange), 0);
  EXPECT_NEAR(cv::countNonZero(instance.mask), 28 * 20, 2 * 20);
}

/// The frame is twice as large and higher: 128 x 128 px become 32 x 32 of an input of 64 x 32.
TEST(MaskRcnnSegmenter, TensorflowFrameOfAnotherShapeIsBroughtBack) {
  MaskRcnnSegmenter segmenter = MakeTensorflow({64, 32});
  const cv::Mat image(128, 128, CV_8UC3, cv::Scalar(255, 0, 204));
  const auto segmentation = segmenter.Segment(test::MakeFrame(image));
  ASSERT_FALSE(segmentation.instances.empty());
  for (const Instance& instance : segmentation.instances) {
    EXPECT_EQ(instance.mask.size(), cv::Size(128, 128));
    EXPECT_NEAR(instance.score, 0.8F, 1e-4);
  }
  // The first cell, at (8, 8), has the box x 0 to 28, y 0 to 20 of the input, four times that here.
  EXPECT_EQ(segmentation.instances[0].box, cv::Rect(0, 0, 112, 80));
  EXPECT_EQ(cv::countNonZero(segmentation.instances[0].mask), 112 * 80);
}

TEST(MaskRcnnSegmenter, OptionsReachTheDecoder) {
  EXPECT_THAT(MakeTensorflow({64, 32}, {.score_threshold = 0.9})
                  .Segment(test::MakeFrame(PersonImage()))
                  .instances,
              SizeIs(0));
  EXPECT_THAT(MakeTensorflow({64, 32}, {.min_area_px = 28 * 20 + 2 * 20 + 1})
                  .Segment(test::MakeFrame(PersonImage()))
                  .instances,
              SizeIs(0));
}

TEST(MaskRcnnSegmenter, TorchvisionInstanceIsWhereTheNetworkSaysIt) {
  if (!OnnxRuntimeNetwork::IsAvailable()) GTEST_SKIP() << "built without ONNX Runtime";
  const TestFolder folder;
  MaskRcnnSegmenter segmenter(std::make_unique<OnnxMaskRcnn>(
                                  folder.Write("net.onnx", test::MakeOnnxMaskRcnn()), cv::Size()),
                              {}, {.score_threshold = 0.3});
  cv::Mat image(32, 64, CV_8UC3, cv::Scalar(0, 0, 102));
  image(cv::Rect(0, 0, 32, 32)).setTo(cv::Scalar(255, 0, 102));
  const auto instances = segmenter.Segment(test::MakeFrame(image)).instances;
  ASSERT_THAT(instances, SizeIs(1));
  EXPECT_EQ(segmenter.class_names().at(instances[0].class_id.value), "chair");
  cv::Mat expected = cv::Mat::zeros(32, 64, CV_8UC1);
  expected(cv::Rect(8, 4, 24, 20)) = 255;
  EXPECT_EQ(cv::countNonZero(instances[0].mask != expected), 0);
}

/// 320 x 240 px are scaled by 800 / 240; the box of 100 x 200 px in the input is 30 x 60 px here.
TEST(MaskRcnnSegmenter, ZooMaskIsPastedIntoItsBox) {
  if (!OnnxRuntimeNetwork::IsAvailable()) GTEST_SKIP() << "built without ONNX Runtime";
  const TestFolder folder;
  const std::string bytes = test::MakeOnnxMaskRcnn(
      {.masks = test::MaskSize::kBox, .label = 1, .box = {200, 100, 299, 299}});
  MaskRcnnSegmenter segmenter(
      std::make_unique<OnnxMaskRcnn>(folder.Write("net.onnx", bytes), cv::Size()), {}, {});
  const cv::Mat image(240, 320, CV_8UC3, cv::Scalar::all(255));
  const auto instances = segmenter.Segment(test::MakeFrame(image)).instances;
  ASSERT_THAT(instances, SizeIs(1));
  EXPECT_EQ(segmenter.class_names().at(instances[0].class_id.value), "person");
  EXPECT_EQ(instances[0].box, cv::Rect(60, 30, 30, 60));
  EXPECT_EQ(cv::countNonZero(instances[0].mask), 15 * 60);
}

TEST(MaskRcnnSegmenter, NamesMustFitTheNetwork) {
  const TestFolder folder;
  const test::TensorflowNetwork network = test::MakeTensorflowMaskRcnn(3);
  const TensorflowMaskRcnnModel model{folder.Write("net.pb", network.graph),
                                      folder.Write("net.pbtxt", network.text_graph),
                                      {64, 32}};
  const auto make = [&](const std::vector<std::string>& names) {
    return MaskRcnnSegmenter(std::make_unique<TensorflowMaskRcnn>(model), names, {});
  };
  MaskRcnnSegmenter named = make({"red", "nothing", "green"});
  const auto instances = named.Segment(test::MakeFrame(PersonImage())).instances;
  ASSERT_THAT(instances, SizeIs(1));
  EXPECT_EQ(named.class_names().at(instances[0].class_id.value), "red");
  EXPECT_THAT(ErrorOf([&] { make({"red"}); }), HasSubstr("3 classes apart but 1 have a name"));
  EXPECT_THAT(ErrorOf([&] { make({}); }), HasSubstr("perception.class_names_file"));
}

}  // namespace
}  // namespace ofm
