#include "ofm/perception/depth_range.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace ofm {
namespace {

TEST(DepthRange, SpansTheMiddleEightTenthsAndTheMargin) {
  std::vector<float> depths;
  for (int i = 0; i <= 100; ++i) depths.push_back(1 + 0.01F * static_cast<float>(i));
  const auto range = FindDepthRange(depths, 0.3, 4);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->near_m, 0.8, 1e-5);
  EXPECT_NEAR(range->far_m, 2.2, 1e-5);
  EXPECT_TRUE(range->Contains(0.81F));
  EXPECT_FALSE(range->Contains(2.21F));
}

TEST(DepthRange, ATenthOfWildDepthsDoesNotMatter) {
  std::vector<float> depths(90, 1.5F);
  depths.insert(depths.end(), 9, 8.0F);
  EXPECT_NEAR(FindDepthRange(depths, 10, 4)->far_m, 11.5, 1e-5);
}

TEST(DepthRange, IsThatOfTheLargestCluster) {
  std::vector<float> depths(40, 3.0F);
  for (int i = 0; i < 60; ++i) depths.push_back(1 + 0.01F * static_cast<float>(i));
  const auto range = FindDepthRange(depths, 0.3, 4);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->near_m, 1.05 - 0.3, 1e-5);
  EXPECT_NEAR(range->far_m, 1.54 + 0.3, 1e-5);
}

TEST(DepthRange, SamplesEveryNthRowAndColumn) {
  const cv::Mat mask(9, 9, CV_8UC1, cv::Scalar(255)), depth_m(9, 9, CV_32FC1, cv::Scalar(1));
  EXPECT_EQ(SampleDepths(mask, depth_m, 4).size(), 9U);
  EXPECT_THROW(SampleDepths(mask, depth_m, 0), std::logic_error);
}

TEST(DepthRange, WhatWasNotMeasuredDoesNotCount) {
  EXPECT_FALSE(FindDepthRange({0, 0, 0, 1.0F}, 0.1, 2));
  EXPECT_FALSE(FindDepthRange({}, 0.1, 0));
  EXPECT_NEAR(FindDepthRange({0, 0, 0, 1.0F}, 0.1, 1)->near_m, 0.9, 1e-5);
}

TEST(DepthRange, TrimsWhatIsMeasuredOutsideIt) {
  const cv::Mat depth_m = (cv::Mat_<float>(1, 5) << 0.5F, 1.0F, 1.2F, 3.0F, 0.0F);
  cv::Mat mask(1, 5, CV_8UC1, cv::Scalar(255));
  TrimToDepth(depth_m, {0.9F, 1.3F}, mask);
  EXPECT_EQ(cv::countNonZero(mask != (cv::Mat_<std::uint8_t>(1, 5) << 0, 255, 255, 0, 255)), 0);
  EXPECT_EQ(SampleDepths(mask, depth_m, 1), (std::vector<float>{1.0F, 1.2F, 0.0F}));
}

}  // namespace
}  // namespace ofm
