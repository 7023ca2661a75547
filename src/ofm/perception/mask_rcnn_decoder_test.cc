#include "ofm/perception/mask_rcnn_decoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

namespace ofm {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const cv::Size kInput(128, 96);

cv::Mat Everywhere(float probability = 1, cv::Size size = {28, 28}) {
  return {size, CV_32FC1, cv::Scalar(probability)};
}

/// Left half of the cells.
cv::Mat LeftHalf(cv::Size size) {
  cv::Mat mask = cv::Mat::zeros(size, CV_32FC1);
  mask(cv::Rect(0, 0, size.width / 2, size.height)) = 1;
  return mask;
}

std::vector<Instance> Decode(const std::vector<MaskRcnnDetection>& detections,
                             const MaskRcnnDecoderOptions& options = {}, cv::Size image = kInput) {
  return DecodeMaskRcnn(detections, MakeLetterbox(image, kInput), MakeContiguousClassMap(3),
                        options);
}

TEST(MaskRcnnDecoder, BoxMaskIsPastedIntoItsBox) {
  const auto instances = Decode({{2, 0.75F, {10, 20, 40, 30}, LeftHalf({28, 28})}});
  ASSERT_THAT(instances, SizeIs(1));
  EXPECT_EQ(instances[0].id, InstanceId(0));
  EXPECT_EQ(instances[0].class_id, ClassId(1));
  EXPECT_EQ(instances[0].score, 0.75F);
  EXPECT_EQ(instances[0].box, cv::Rect(10, 20, 40, 30));
  cv::Mat expected = cv::Mat::zeros(kInput, CV_8UC1);
  expected(cv::Rect(10, 20, 20, 30)) = 255;
  EXPECT_EQ(cv::countNonZero(instances[0].mask != expected), 0);
}

TEST(MaskRcnnDecoder, InputMaskIsTakenWhereItLiesAndCutToTheBox) {
  const auto instances =
      Decode({{1, 0.9F, {50, 10, 40, 20}, LeftHalf(kInput), MaskExtent::kInput}});
  ASSERT_THAT(instances, SizeIs(1));
  cv::Mat expected = cv::Mat::zeros(kInput, CV_8UC1);
  expected(cv::Rect(50, 10, 14, 20)) = 255;
  EXPECT_EQ(cv::countNonZero(instances[0].mask != expected), 0);
}

/// 256 x 256 px become 96 x 96, 16 px from the left: x_image = (x - 16) * 8 / 3.
TEST(MaskRcnnDecoder, LetterboxIsUndone) {
  for (const MaskExtent extent : {MaskExtent::kBox, MaskExtent::kInput}) {
    cv::Mat mask = Everywhere(1, kInput);
    const auto instances = Decode({{1, 0.9F, {40, 30, 24, 48}, mask, extent}}, {}, {256, 256});
    ASSERT_THAT(instances, SizeIs(1));
    EXPECT_EQ(instances[0].box, cv::Rect(64, 80, 64, 128));
    EXPECT_EQ(instances[0].mask.size(), cv::Size(256, 256));
    EXPECT_EQ(cv::countNonZero(instances[0].mask), 64 * 128);
    EXPECT_EQ(cv::countNonZero(instances[0].mask(instances[0].box)), 64 * 128);
  }
}

/// The input's mask is scaled and moved, not only its box: 50 input px are 133.3 image px.
TEST(MaskRcnnDecoder, InputMaskIsScaledBackToTheImage) {
  cv::Mat mask = cv::Mat::zeros(kInput, CV_32FC1);
  mask(cv::Rect(16, 0, 50, 96)) = 1;
  const auto instances =
      Decode({{1, 0.9F, {0, 0, 128, 96}, mask, MaskExtent::kInput}}, {}, {256, 256});
  ASSERT_THAT(instances, SizeIs(1));
  EXPECT_EQ(cv::countNonZero(instances[0].mask.row(100)), 133);
  EXPECT_EQ(instances[0].mask.at<std::uint8_t>(100, 132), 255);
}

TEST(MaskRcnnDecoder, BoxOutOfTheImageKeepsItsMaskInPlace) {
  const auto instances = Decode({{1, 0.9F, {-20, -10, 60, 40}, LeftHalf({28, 28})}});
  ASSERT_THAT(instances, SizeIs(1));
  EXPECT_EQ(instances[0].box, cv::Rect(0, 0, 40, 30));
  EXPECT_EQ(cv::countNonZero(instances[0].mask), 10 * 30);
}

TEST(MaskRcnnDecoder, MostConfidentComeFirstAndTheOthersOverTheLimitAreDropped) {
  std::vector<MaskRcnnDetection> detections;
  for (const float score : {0.5F, 0.9F, 0.7F, 0.9F}) {
    detections.push_back({1, score, {10.0 + std::ssize(detections), 10, 8, 8}, Everywhere()});
  }
  std::vector<int> left;
  for (const Instance& instance : Decode(detections, {.max_instances = 3})) {
    EXPECT_EQ(instance.id.value, left.size());
    left.push_back(instance.box.x);
  }
  EXPECT_THAT(left, ElementsAre(11, 13, 12));
}

TEST(MaskRcnnDecoder, ScoreThresholdIsTheLeastScore) {
  const std::vector<MaskRcnnDetection> detections = {{1, 0.5F, {10, 10, 8, 8}, Everywhere()}};
  EXPECT_THAT(Decode(detections, {.score_threshold = 0.5}), SizeIs(1));
  EXPECT_THAT(Decode(detections, {.score_threshold = 0.51}), IsEmpty());
}

TEST(MaskRcnnDecoder, MaskThresholdDecidesOnAPixel) {
  const std::vector<MaskRcnnDetection> detections = {{1, 0.9F, {10, 10, 8, 8}, Everywhere(0.4F)}};
  EXPECT_THAT(Decode(detections), IsEmpty());
  EXPECT_THAT(Decode(detections, {.mask_threshold = 0.3}), SizeIs(1));
}

TEST(MaskRcnnDecoder, MasksUnderTheLeastAreaAreDropped) {
  const std::vector<MaskRcnnDetection> detections = {{1, 0.9F, {10, 10, 8, 8}, LeftHalf({8, 8})}};
  EXPECT_THAT(Decode(detections, {.min_area_px = 32}), SizeIs(1));
  EXPECT_THAT(Decode(detections, {.min_area_px = 33}), IsEmpty());
}

TEST(MaskRcnnDecoder, LabelsWithoutAClassAreDropped) {
  std::vector<MaskRcnnDetection> detections;
  for (const int label : {0, 4, -1, 1000}) {
    detections.push_back({label, 0.9F, {10, 10, 8, 8}, Everywhere()});
  }
  EXPECT_THAT(Decode(detections), IsEmpty());
}

TEST(MaskRcnnDecoder, NumbersThatMakeNoSenseAreDropped) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const float bad_score = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(Decode({{1, 0.9F, {nan, 0, 8, 8}, Everywhere()},
                      {1, 0.9F, {0, 0, infinity, 8}, Everywhere()},
                      {1, 0.9F, {0, 0, 0, 8}, Everywhere()},
                      {1, 0.9F, {20, 20, 8, -8}, Everywhere()},
                      {1, 0.9F, {500, 20, 8, 8}, Everywhere()},
                      {1, 0.9F, {20, 20, 8, 8}, cv::Mat()},
                      {1, 0.9F, {20, 20, 8, 8}, Everywhere(bad_score)},
                      {1, bad_score, {0, 0, 8, 8}, Everywhere()}}),
              IsEmpty());
  EXPECT_THAT(Decode({}), IsEmpty());
}

TEST(MaskRcnnDecoder, HugeBoxIsCutToTheImage) {
  const auto instances = Decode({{1, 2.0F, {-1e12, -1e12, 2e12, 2e12}, Everywhere()}});
  ASSERT_THAT(instances, SizeIs(1));
  EXPECT_EQ(instances[0].box, cv::Rect({}, kInput));
  EXPECT_EQ(instances[0].score, 1.0F);
}

}  // namespace
}  // namespace ofm
