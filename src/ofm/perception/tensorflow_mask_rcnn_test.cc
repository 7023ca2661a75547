#include "ofm/perception/tensorflow_mask_rcnn.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/io/test_folder.h"
#include "ofm/perception/mask_rcnn_test_support.h"

namespace ofm {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

class TensorflowGraph : public ::testing::Test {
 protected:
  TensorflowMaskRcnnModel Write(const test::TensorflowNetwork& network, cv::Size input = {}) const {
    return {folder_.Write("net.pb", network.graph), folder_.Write("net.pbtxt", network.text_graph),
            input};
  }
  std::string LoadError(const test::TensorflowNetwork& network) const {
    const TensorflowMaskRcnnModel model = Write(network);
    return ErrorOf([&] { TensorflowMaskRcnn{model}; });
  }

  TestFolder folder_;
};

/// The cell at 16 to 32 px is red, the image's left half blue besides.
cv::Mat PersonImage() {
  cv::Mat image(32, 64, CV_8UC3, cv::Scalar(0, 0, 0));
  image(cv::Rect(0, 0, 32, 32)).setTo(cv::Scalar(255, 0, 0));
  image(cv::Rect(16, 0, 16, 16)).setTo(cv::Scalar(255, 0, 204));
  return image;
}

TEST_F(TensorflowGraph, GivesTheLayersOutputsAsDetections) {
  TensorflowMaskRcnn network(Write(test::MakeTensorflowMaskRcnn(), {64, 32}));
  const auto detections = network.Detect(PersonImage(), network.Fit({64, 32}));
  ASSERT_THAT(detections, SizeIs(1));
  EXPECT_EQ(detections[0].label, 1);
  EXPECT_NEAR(detections[0].score, 0.8F, 1e-5);
  EXPECT_EQ(detections[0].extent, MaskExtent::kBox);
  EXPECT_EQ(detections[0].mask.size(), cv::Size(15, 15));
  // 40 x 24 px around (24, 8), cut at the border.
  EXPECT_NEAR(detections[0].box.x, 4, 1e-4);
  EXPECT_NEAR(detections[0].box.y, 0, 1e-4);
  EXPECT_NEAR(detections[0].box.br().x, 44, 1e-4);
  EXPECT_NEAR(detections[0].box.br().y, 20, 1e-4);
}

TEST_F(TensorflowGraph, EachClassHasItsOwnMask) {
  TensorflowMaskRcnn network(Write(test::MakeTensorflowMaskRcnn(), {64, 32}));
  cv::Mat image(32, 64, CV_8UC3, cv::Scalar(255, 0, 0));
  image(cv::Rect(16, 0, 16, 16)).setTo(cv::Scalar(255, 153, 204));
  const auto detections = network.Detect(image, network.Fit({64, 32}));
  ASSERT_THAT(detections, SizeIs(2));
  EXPECT_EQ(detections[0].label, 1);
  EXPECT_EQ(detections[1].label, 62);
  EXPECT_NEAR(detections[1].score, 0.6F, 1e-5);
  EXPECT_GT(detections[0].mask.at<float>(7, 7), 0.99F);
  EXPECT_LT(detections[1].mask.at<float>(7, 7), 0.01F);
}

TEST_F(TensorflowGraph, NothingSeenGivesNoDetection) {
  TensorflowMaskRcnn network(Write(test::MakeTensorflowMaskRcnn(), {64, 32}));
  EXPECT_THAT(network.Detect(cv::Mat::zeros(32, 64, CV_8UC3), network.Fit({64, 32})), IsEmpty());
  // and something again after that
  EXPECT_THAT(network.Detect(PersonImage(), network.Fit({64, 32})), SizeIs(1));
}

TEST_F(TensorflowGraph, InputIsTheTrainingSizeUnlessSaidOtherwise) {
  const test::TensorflowNetwork small = test::MakeTensorflowMaskRcnn();
  EXPECT_EQ(TensorflowMaskRcnn(Write(small)).Fit({640, 480}).input, cv::Size(1067, 800));
  EXPECT_EQ(TensorflowMaskRcnn(Write(small, {64, 64})).Fit({640, 480}).input, cv::Size(64, 64));
}

TEST_F(TensorflowGraph, ImagesOfSeveralSizesGoThroughOneNetwork) {
  TensorflowMaskRcnn network(Write(test::MakeTensorflowMaskRcnn()));
  const auto small = network.Detect(PersonImage(), FitMaskRcnnInput({64, 32}, {.shorter_side = 0}));
  const auto scaled =
      network.Detect(PersonImage(), FitMaskRcnnInput({64, 32}, {.shorter_side = 64}));
  ASSERT_THAT(small, SizeIs(1));
  ASSERT_FALSE(scaled.empty());  // four cells are red now
  EXPECT_EQ(scaled[0].label, 1);
}

TEST_F(TensorflowGraph, NinetyClassesAreCocosLabels) {
  TensorflowMaskRcnn network(Write(test::MakeTensorflowMaskRcnn(), {64, 32}));
  const ClassMap classes = network.MapToCoco();
  EXPECT_EQ(FindClassOfLabel(classes, 1), ClassId(0));
  EXPECT_EQ(FindClassOfLabel(classes, 62), ClassId(56));  // chair
  EXPECT_THAT(ErrorOf([&] { network.MapToNames(3); }),
              HasSubstr("net.pb: the network tells 90 classes apart but 3 have a name"));
}

TEST_F(TensorflowGraph, OtherClassesNeedNames) {
  TensorflowMaskRcnn network(Write(test::MakeTensorflowMaskRcnn(3), {64, 32}));
  EXPECT_THAT(
      ErrorOf([&] { network.MapToCoco(); }),
      AllOf(HasSubstr("net.pb: tells 3 classes apart"), HasSubstr("perception.class_names_file")));
  EXPECT_EQ(FindClassOfLabel(network.MapToNames(3), 3), ClassId(2));
}

TEST_F(TensorflowGraph, MissingFilesAreNamed) {
  const TensorflowMaskRcnnModel model = Write(test::MakeTensorflowMaskRcnn());
  EXPECT_THAT(ErrorOf([&] {
                TensorflowMaskRcnn({"/no/such.pb", model.text_graph, {}});
              }),
              HasSubstr("/no/such.pb: does not exist"));
  EXPECT_THAT(ErrorOf([&] {
                TensorflowMaskRcnn({model.graph, "/no/such.pbtxt", {}});
              }),
              HasSubstr("/no/such.pbtxt: does not exist"));
}

TEST_F(TensorflowGraph, FilesOfAnotherKindAreNamedAndNothingIsOnStderr) {
  test::TensorflowNetwork text = test::MakeTensorflowMaskRcnn(), cut = text, other = text;
  text.graph = "version https://git-lfs.github.com/spec/v1\n";
  cut.graph.resize(cut.graph.size() / 2);
  other.text_graph = "node { name: \"a\" op: \"b\" }\n";
  ::testing::internal::CaptureStderr();
  const std::string text_error = LoadError(text), cut_error = LoadError(cut),
                    other_error = LoadError(other);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(text_error, HasSubstr("net.pb: is no frozen TensorFlow graph"));
  EXPECT_THAT(cut_error, HasSubstr("ends too early"));
  EXPECT_THAT(other_error, HasSubstr("net.pbtxt: is no text graph of a Mask R-CNN"));
}

TEST_F(TensorflowGraph, TextGraphOfAnotherNetworkIsOneLineOfError) {
  test::TensorflowNetwork network = test::MakeTensorflowMaskRcnn();
  network.graph = test::Message().Add(1, test::TensorflowConstant("other", {1}, {0})).bytes();
  const std::string error = LoadError(network);
  EXPECT_THAT(error,
              AllOf(HasSubstr("net.pb: OpenCV cannot load this network"), Not(HasSubstr("\n"))));
}

TEST_F(TensorflowGraph, SameImageGivesTheSameDetections) {
  TensorflowMaskRcnn network(Write(test::MakeTensorflowMaskRcnn(), {64, 32}));
  const cv::Mat first = network.Detect(PersonImage(), network.Fit({64, 32})).at(0).mask.clone();
  const cv::Mat second = network.Detect(PersonImage(), network.Fit({64, 32})).at(0).mask;
  EXPECT_EQ(cv::countNonZero(first != second), 0);
}

}  // namespace
}  // namespace ofm
