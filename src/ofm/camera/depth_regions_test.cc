#include "ofm/camera/depth_regions.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace ofm {
namespace {

TEST(DepthRegions, StepsPartSurfacesAndSlopesDoNot) {
  cv::Mat depth_m(20, 60, CV_32FC1, cv::Scalar(3));
  for (int x = 0; x < 30; ++x) depth_m.col(x).setTo(1 + 0.03F * static_cast<float>(x));
  const cv::Mat mask(depth_m.size(), CV_8UC1, cv::Scalar(255));
  const auto regions = FindDepthRegions(mask, depth_m, 0.05F);
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0].pixels.size(), 30U * 20U);
  EXPECT_EQ(regions[1].pixels.size(), 30U * 20U);
  EXPECT_EQ(FindDepthRegions(mask, depth_m, 0.01F).size(), 31U);
}

TEST(DepthRegions, LooksOnlyInTheMaskAndWhereDepthWasMeasured) {
  cv::Mat depth_m(10, 30, CV_32FC1, cv::Scalar(1));
  depth_m(cv::Rect(10, 0, 2, 10)).setTo(0);
  cv::Mat mask = cv::Mat::zeros(depth_m.size(), CV_8UC1);
  mask(cv::Rect(0, 0, 20, 10)).setTo(255);
  const auto regions = FindDepthRegions(mask, depth_m, 0.1F);
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0].pixels.size(), 100U);
  EXPECT_EQ(regions[1].pixels.size(), 80U);
  EXPECT_TRUE(FindDepthRegions(cv::Mat::zeros(10, 30, CV_8UC1), depth_m, 0.1F).empty());
}

}  // namespace
}  // namespace ofm
