#include "ofm/dense/usable_pixels.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

namespace ofm {
namespace {

constexpr int kSize = 40;

/// 1 m on the left of column 20, 2 m from there on.
cv::Mat StepDepth() {
  cv::Mat depth(kSize, kSize, CV_32FC1, cv::Scalar(2));
  depth.colRange(0, 20) = 1;
  return depth;
}

TEST(FindSmoothPixels, BothRimsOfADepthStepGoAndNothingElse) {
  const cv::Mat smooth = FindSmoothPixels(StepDepth(), {});
  for (int column = 0; column < kSize; ++column) {
    const int expected = column == 19 || column == 20 ? 0 : 255;
    EXPECT_EQ(smooth.at<std::uint8_t>(10, column), expected) << column;
  }
}

TEST(FindSmoothPixels, FlyingPixelsBetweenTwoSurfacesGo) {
  cv::Mat depth = StepDepth();
  depth.col(19) = 1.5;
  const cv::Mat smooth = FindSmoothPixels(depth, {});
  for (const int column : {18, 19, 20}) EXPECT_EQ(smooth.at<std::uint8_t>(10, column), 0);
  EXPECT_EQ(smooth.at<std::uint8_t>(10, 17), 255);
}

TEST(FindSmoothPixels, WhatIsAnEdgeNearbyIsNoiseFarAway) {
  const auto with_step = [](float depth_m) {
    cv::Mat depth(kSize, kSize, CV_32FC1, cv::Scalar(depth_m));
    depth.colRange(20, kSize) = depth_m + .03f;
    return FindSmoothPixels(depth, {}).at<std::uint8_t>(10, 19);
  };
  EXPECT_EQ(with_step(1), 0);
  EXPECT_EQ(with_step(3), 255);
}

TEST(FindSmoothPixels, ASlantedSurfaceStays) {
  cv::Mat depth(kSize, kSize, CV_32FC1);
  for (int row = 0; row < kSize; ++row) depth.row(row) = 1 + .005 * row;
  EXPECT_EQ(cv::countNonZero(FindSmoothPixels(depth, {})), kSize * kSize);
}

TEST(FindSmoothPixels, UnmeasuredAndImpossibleDepthsAndLonePixelsGo) {
  cv::Mat depth(kSize, kSize, CV_32FC1, cv::Scalar(1));
  depth.at<float>(5, 5) = 0;
  depth.at<float>(15, 15) = std::numeric_limits<float>::quiet_NaN();
  depth.at<float>(25, 25) = std::numeric_limits<float>::infinity();
  depth(cv::Rect(28, 28, 7, 7)) = 0;
  depth.at<float>(31, 31) = 1;  // alone in the hole
  const cv::Mat smooth = FindSmoothPixels(depth, {});
  for (const int at : {5, 15, 25, 31}) EXPECT_EQ(smooth.at<std::uint8_t>(at, at), 0) << at;
  for (const int at : {4, 14, 24, 10}) EXPECT_EQ(smooth.at<std::uint8_t>(at, at), 255) << at;
}

/// Somebody at 1 m in columns 0 to 19 whose mask ends too early, at column 15.
cv::Mat SmallMask() {
  cv::Mat mask(kSize, kSize, CV_8UC1, cv::Scalar(0));
  mask.colRange(0, 16) = 255;
  return mask;
}

TEST(FindDynamicPixels, TheRimThatAMaskMissesGoesByItsDepth) {
  KeyframeCloudOptions options;
  options.mask_dilation_px = 2;
  const cv::Mat dynamic = FindDynamicPixels(SmallMask(), StepDepth(), options);
  for (const int column : {0, 17, 19}) EXPECT_EQ(dynamic.at<std::uint8_t>(20, column), 255);
  for (const int column : {20, 25}) EXPECT_EQ(dynamic.at<std::uint8_t>(20, column), 0);
}

TEST(FindDynamicPixels, WithoutMarginTheMaskIsOnlyDilated) {
  KeyframeCloudOptions options;
  options.mask_dilation_px = 2, options.mask_margin_px = 0;
  const cv::Mat dynamic = FindDynamicPixels(SmallMask(), StepDepth(), options);
  EXPECT_EQ(cv::countNonZero(dynamic), 18 * kSize);
}

TEST(FindDynamicPixels, AnEmptyMaskDropsNothing) {
  const cv::Mat none(kSize, kSize, CV_8UC1, cv::Scalar(0));
  EXPECT_EQ(cv::countNonZero(FindDynamicPixels(none, StepDepth(), {})), 0);
}

TEST(FindUsablePixels, SmoothAndStaticPixelsAreLeft) {
  LabelledFrame frame;
  frame.depth_m = StepDepth();
  EXPECT_EQ(cv::countNonZero(FindUsablePixels(frame, {})), 38 * kSize);
  frame.dynamic_mask = SmallMask();
  EXPECT_EQ(cv::countNonZero(FindUsablePixels(frame, {})), 19 * kSize);
}

}  // namespace
}  // namespace ofm
