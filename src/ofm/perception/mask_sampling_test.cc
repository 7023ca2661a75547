#include "ofm/perception/mask_sampling.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace ofm {
namespace {

TEST(PasteMask, CellsOfWholePixelsAreTakenAsTheyAre) {
  const cv::Mat values = (cv::Mat_<float>(2, 2) << 1, 0, 0, 1);
  const cv::Mat mask = PasteMask({values, {3, 2, 2, 2}}, 0.5F, {3, 2, 2, 2}, {8, 6});
  cv::Mat expected = cv::Mat::zeros(6, 8, CV_8UC1);
  expected.at<std::uint8_t>(2, 3) = expected.at<std::uint8_t>(3, 4) = 255;
  EXPECT_EQ(cv::countNonZero(mask != expected), 0);
}

/// Two cells, 0 and 1, over 8 px: their centres are 2 and 6, so the ramp crosses t at 2 + 4 t.
TEST(PasteMask, InterpolatesBetweenTheCentresOfCells) {
  const cv::Mat values = (cv::Mat_<float>(1, 2) << 0, 1);
  for (const auto& [threshold, first] : {std::pair{0.5F, 4}, {0.25F, 3}, {0.75F, 5}, {0.99F, 6}}) {
    const cv::Mat mask = PasteMask({values, {0, 0, 8, 1}}, threshold, {0, 0, 8, 1}, {8, 1});
    EXPECT_EQ(cv::countNonZero(mask), 8 - first) << threshold;
    EXPECT_EQ(mask.at<std::uint8_t>(0, first), 255) << threshold;
  }
}

TEST(PasteMask, WhatLeavesTheImageIsCutAndTheRestStaysInPlace) {
  const cv::Mat values = (cv::Mat_<float>(1, 4) << 1, 1, 0, 1);
  const cv::Mat mask = PasteMask({values, {-2, 0, 8, 4}}, 0.5F, {0, 0, 6, 4}, {7, 4});
  for (int y = 0; y < 4; ++y) {
    const cv::Mat row = (cv::Mat_<std::uint8_t>(1, 7) << 255, 255, 0, 0, 255, 255, 0);
    EXPECT_EQ(cv::countNonZero(mask.row(y) != row), 0) << y;
  }
}

TEST(PasteMask, NothingOutsideTheBoxIsSet) {
  const cv::Mat mask = PasteMask({cv::Mat(2, 2, CV_32FC1, cv::Scalar(1)), {0, 0, 10, 10}}, 0.5F,
                                 {2, 3, 4, 5}, {10, 10});
  EXPECT_EQ(cv::boundingRect(mask), cv::Rect(2, 3, 4, 5));
  EXPECT_EQ(cv::countNonZero(mask), 20);
}

TEST(PasteMask, EmptyBoxGivesAnEmptyMask) {
  const cv::Mat mask =
      PasteMask({cv::Mat(2, 2, CV_32FC1, cv::Scalar(1)), {0, 0, 4, 4}}, 0.5F, {}, {4, 4});
  EXPECT_EQ(mask.size(), cv::Size(4, 4));
  EXPECT_EQ(cv::countNonZero(mask), 0);
}

/// A disc of probability in 28 x 28 cells: pasted, its area is that of the ellipse it stands for.
TEST(PasteMask, AreaOfASmoothShapeIsKept) {
  cv::Mat values(28, 28, CV_32FC1);
  for (int y = 0; y < 28; ++y) {
    for (int x = 0; x < 28; ++x) {
      const double r = std::hypot(x + 0.5 - 14, y + 0.5 - 14);
      values.at<float>(y, x) = static_cast<float>(1 / (1 + std::exp(2 * (r - 9))));
    }
  }
  const cv::Rect2d extent(20.25, 10.5, 173.5, 301.25);
  const cv::Mat mask = PasteMask({values, extent}, 0.5F, {20, 10, 175, 303}, {320, 330});
  const double area = CV_PI * (9.0 / 28 * extent.width) * (9.0 / 28 * extent.height);
  EXPECT_NEAR(cv::countNonZero(mask) / area, 1, 0.01);
  const cv::Moments moments = cv::moments(mask, true);
  EXPECT_NEAR(moments.m10 / moments.m00 + 0.5, extent.x + extent.width / 2, 0.2);
  EXPECT_NEAR(moments.m01 / moments.m00 + 0.5, extent.y + extent.height / 2, 0.2);
}

TEST(PasteMask, MaskWithoutExtentIsAProgrammersError) {
  const cv::Mat values(2, 2, CV_32FC1, cv::Scalar(1));
  EXPECT_THROW(PasteMask({values, {0, 0, 0, 4}}, 0.5F, {0, 0, 1, 1}, {4, 4}), std::logic_error);
  EXPECT_THROW(PasteMask({cv::Mat(), {0, 0, 4, 4}}, 0.5F, {0, 0, 1, 1}, {4, 4}), std::logic_error);
}

}  // namespace
}  // namespace ofm
