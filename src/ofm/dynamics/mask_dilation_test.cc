#include "ofm/dynamics/mask_dilation.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "ofm/base/random.h"

namespace ofm {
namespace {

cv::Mat Dilated(const cv::Mat& object, int radius) {
  cv::Mat mask = cv::Mat::zeros(object.size(), CV_8UC1);
  AddDilated(object, radius, mask);
  return mask;
}

/// Blobs, single pixels, and pixels on all borders.
cv::Mat MakeObject(std::uint64_t seed) {
  cv::Mat object = cv::Mat::zeros(90, 120, CV_8UC1);
  RandomEngine engine = MakeRandomEngine(seed, 0);
  for (int i = 0; i < 6; ++i) {
    const cv::Point centre(static_cast<int>(UniformIndex(engine, 120)),
                           static_cast<int>(UniformIndex(engine, 90)));
    cv::circle(object, centre, static_cast<int>(UniformIndex(engine, 9)), cv::Scalar(255), -1);
    object.at<std::uint8_t>(UniformIndex(engine, 90), UniformIndex(engine, 120)) = 1;
  }
  object.at<std::uint8_t>(0, 0) = object.at<std::uint8_t>(89, 119) = 255;
  return object;
}

TEST(MaskDilation, EqualsOpenCvsDilationWithAnEllipse) {
  for (const int radius : {0, 1, 2, 5, 7, 15, 40}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const cv::Mat object = MakeObject(seed);
      const cv::Mat ellipse =
          cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * radius + 1, 2 * radius + 1));
      cv::Mat expected;
      cv::dilate(object != 0, expected, ellipse);
      EXPECT_EQ(cv::countNonZero(Dilated(object, radius) != expected), 0) << radius << " " << seed;
    }
  }
}

TEST(MaskDilation, NothingGrowsToNothing) {
  EXPECT_EQ(cv::countNonZero(Dilated(cv::Mat::zeros(20, 30, CV_8UC1), 7)), 0);
}

TEST(MaskDilation, FullMaskStaysFull) {
  EXPECT_EQ(cv::countNonZero(Dilated(cv::Mat(20, 30, CV_8UC1, cv::Scalar(255)), 7)), 600);
}

TEST(MaskDilation, WhatWasMaskedStaysMasked) {
  cv::Mat object = cv::Mat::zeros(40, 40, CV_8UC1), mask = object.clone();
  object.at<std::uint8_t>(10, 10) = 255;
  mask.at<std::uint8_t>(35, 35) = 255;
  AddDilated(object, 3, mask);
  EXPECT_EQ(mask.at<std::uint8_t>(35, 35), 255);
  EXPECT_EQ(mask.at<std::uint8_t>(10, 13), 255);
}

TEST(MaskDilation, SizesThatDifferAreAProgrammersError) {
  cv::Mat mask = cv::Mat::zeros(40, 40, CV_8UC1);
  EXPECT_THROW(AddDilated(cv::Mat::zeros(40, 41, CV_8UC1), 3, mask), std::logic_error);
}

}  // namespace
}  // namespace ofm
