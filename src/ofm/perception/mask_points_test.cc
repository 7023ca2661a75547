#include "ofm/perception/mask_points.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "ofm/perception/test_support.h"

namespace ofm {
namespace {

const cv::Size kSize(320, 240);
const cv::Rect kBox(60, 40, 150, 120);

cv::Mat BoxMask() {
  cv::Mat mask = cv::Mat::zeros(kSize, CV_8UC1);
  mask(kBox).setTo(255);
  return mask;
}

std::vector<Eigen::Vector2f> Find(const cv::Mat& gray, const cv::Mat& mask,
                                  const MaskPointOptions& options = {}) {
  return FindMaskPoints(BuildFlowPyramid(gray, {}), mask, cv::boundingRect(mask), options);
}

TEST(MaskPoints, GivesAboutOnePointACellOnATexturedObject) {
  const auto points = Find(test::MakeTexture(kSize, 1), BoxMask());
  const double cells = kBox.area() / (15.0 * 15.0);
  EXPECT_GT(static_cast<double>(points.size()), 0.8 * cells);
  EXPECT_LT(static_cast<double>(points.size()), 1.5 * cells);
  for (const Eigen::Vector2f& point : points) {
    EXPECT_TRUE(kBox.contains(cv::Point(cvRound(point.x()), cvRound(point.y()))));
  }
}

TEST(MaskPoints, GivesNoneWhereThereIsNoTexture) {
  EXPECT_TRUE(Find(cv::Mat(kSize, CV_8UC1, cv::Scalar(100)), BoxMask()).empty());
}

/// Along stripes nothing tells one place from the next.
TEST(MaskPoints, GivesNoneOnStripes) {
  cv::Mat stripes(kSize, CV_8UC1);
  for (int x = 0; x < kSize.width; ++x) stripes.col(x).setTo(x / 6 % 2 * 200);
  EXPECT_TRUE(Find(stripes, BoxMask()).empty());
}

TEST(MaskPoints, LargeObjectsGiveNoMoreThanAsked) {
  const cv::Mat mask(kSize, CV_8UC1, cv::Scalar(255));
  const auto points = Find(test::MakeTexture(kSize, 2), mask, {.max_points = 40});
  EXPECT_GT(points.size(), 25U);
  EXPECT_LT(points.size(), 65U);
}

TEST(MaskPoints, NothingGivesNothing) {
  EXPECT_TRUE(Find(test::MakeTexture(kSize, 3), cv::Mat::zeros(kSize, CV_8UC1)).empty());
}

TEST(MaskPoints, SinglePyramidLevelAndOddSizesWork) {
  const cv::Mat gray = test::MakeTexture({101, 77}, 4);
  const FlowPyramid pyramid = BuildFlowPyramid(gray, {.levels = 1});
  const cv::Mat mask(gray.size(), CV_8UC1, cv::Scalar(255));
  EXPECT_GT(FindMaskPoints(pyramid, mask, cv::Rect({}, gray.size()), {}).size(), 10U);
  EXPECT_GT(Find(gray, mask).size(), 10U);
}

}  // namespace
}  // namespace ofm
