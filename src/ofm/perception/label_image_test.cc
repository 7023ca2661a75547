#include "ofm/perception/label_image.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace ofm {
namespace {

Instance MakeInstance(std::uint32_t class_id, float score, const cv::Rect& box) {
  Instance instance{InstanceId(0), ClassId(class_id), score, box, cv::Mat::zeros(20, 30, CV_8UC1)};
  instance.mask(box).setTo(255);
  return instance;
}

TEST(LabelImage, EmptySegmentationHasNoLabelAnywhere) {
  const LabelImage image = ComposeLabelImage({}, {30, 20});
  EXPECT_EQ(image.labels.size(), cv::Size(30, 20));
  EXPECT_EQ(cv::countNonZero(image.labels != kNoLabel), 0);
  EXPECT_EQ(cv::countNonZero(image.confidence), 0);
}

TEST(LabelImage, PixelsHaveClassAndConfidence) {
  const Segmentation segmentation{FrameId(0), {MakeInstance(56, 0.8F, {2, 3, 4, 5})}};
  const LabelImage image = ComposeLabelImage(segmentation, {30, 20});
  EXPECT_EQ(image.labels.type(), CV_8UC1);
  EXPECT_EQ(image.confidence.type(), CV_8UC1);
  EXPECT_EQ(image.labels.at<std::uint8_t>(3, 2), 56);
  EXPECT_EQ(image.confidence.at<std::uint8_t>(3, 2), 204);
  EXPECT_EQ(image.labels.at<std::uint8_t>(2, 2), kNoLabel);
  EXPECT_EQ(cv::countNonZero(image.labels == 56), 20);
}

TEST(LabelImage, MoreConfidentInstanceWinsWhateverTheOrder) {
  const Instance weak = MakeInstance(1, 0.5F, {0, 0, 10, 10});
  const Instance strong = MakeInstance(2, 0.8F, {5, 0, 10, 10});
  for (const auto& instances : {std::vector{weak, strong}, std::vector{strong, weak}}) {
    const LabelImage image = ComposeLabelImage({FrameId(0), instances}, {30, 20});
    EXPECT_EQ(cv::countNonZero(image.labels == 2), 100);
    EXPECT_EQ(cv::countNonZero(image.labels == 1), 50);
    EXPECT_EQ(image.confidence.at<std::uint8_t>(5, 7), 204);
  }
}

TEST(LabelImage, PixelsKnowThePlaceOfTheirInstanceInTheList) {
  Segmentation segmentation;
  segmentation.instances = {MakeInstance(1, .5f, {2, 2, 10, 10}),
                            MakeInstance(1, .9f, {8, 2, 10, 10})};
  const cv::Mat instances = ComposeLabelImage(segmentation, {30, 20}).instances;
  ASSERT_EQ(instances.type(), CV_16UC1);
  EXPECT_EQ(instances.at<std::uint16_t>(4, 4), 0);
  EXPECT_EQ(instances.at<std::uint16_t>(4, 9), 1);
  EXPECT_EQ(instances.at<std::uint16_t>(15, 25), kNoInstance);
}

TEST(LabelImage, FirstOfEquallyConfidentInstancesWins) {
  const Segmentation segmentation{
      FrameId(0), {MakeInstance(1, 1.0F, {0, 0, 9, 9}), MakeInstance(2, 1.0F, {0, 0, 9, 9})}};
  EXPECT_EQ(ComposeLabelImage(segmentation, {30, 20}).labels.at<std::uint8_t>(4, 4), 1);
}

TEST(LabelImage, ClassThatMeansNoLabelIsAProgrammersError) {
  const Segmentation segmentation{FrameId(0), {MakeInstance(255, 1.0F, {0, 0, 9, 9})}};
  EXPECT_THROW(ComposeLabelImage(segmentation, {30, 20}), std::logic_error);
}

}  // namespace
}  // namespace ofm
