#include "ofm/perception/mask_parts.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace ofm {
namespace {

cv::Mat Rectangles(std::initializer_list<cv::Rect> rectangles) {
  cv::Mat mask = cv::Mat::zeros(60, 80, CV_8UC1);
  for (const cv::Rect& rectangle : rectangles) mask(rectangle).setTo(255);
  return mask;
}

TEST(MaskParts, KeepsTheLargestAndThoseNotMuchSmaller) {
  const cv::Rect large(5, 5, 30, 20), medium(50, 5, 10, 10), small(50, 40, 3, 3);
  cv::Mat mask = Rectangles({large, medium, small});
  EXPECT_EQ(KeepLargestParts(0.1, mask), 700);
  EXPECT_EQ(cv::countNonZero(mask != Rectangles({large, medium})), 0);
  EXPECT_EQ(KeepLargestParts(1, mask), 600);
  EXPECT_EQ(cv::countNonZero(mask != Rectangles({large})), 0);
}

TEST(MaskParts, NothingIsLeftOfNothing) {
  cv::Mat mask = Rectangles({});
  EXPECT_EQ(KeepLargestParts(0.5, mask), 0);
}

TEST(MaskParts, ClosesSmallHolesOnly) {
  cv::Mat mask = Rectangles({{5, 5, 50, 40}});
  mask(cv::Rect(10, 10, 3, 3)).setTo(0);
  mask(cv::Rect(25, 15, 15, 15)).setTo(0);
  cv::Mat expected = mask.clone();
  expected(cv::Rect(10, 10, 3, 3)).setTo(255);
  CloseHoles(20, mask);
  EXPECT_EQ(cv::countNonZero(mask != expected), 0);
}

TEST(MaskParts, WhatIsOpenToTheBorderIsNoHole) {
  cv::Mat mask(60, 80, CV_8UC1, cv::Scalar(255));
  mask(cv::Rect(20, 0, 4, 5)).setTo(0);
  const cv::Mat before = mask.clone();
  CloseHoles(1000, mask);
  EXPECT_EQ(cv::countNonZero(mask != before), 0);
}

}  // namespace
}  // namespace ofm
