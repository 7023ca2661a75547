#include "ofm/perception/mask_growth.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace ofm {
namespace {

/// A plate of 40 × 20 px at 1 m in front of a wall at 2 m.
struct Plate {
  cv::Rect plate = {20, 20, 40, 20};
  cv::Mat depth_m = cv::Mat(60, 80, CV_32FC1, cv::Scalar(2));
  cv::Mat mask = cv::Mat::zeros(60, 80, CV_8UC1);

  Plate() {
    depth_m(plate).setTo(1);
    mask(cv::Rect(30, 24, 10, 12)).setTo(255);
  }
  cv::Mat Whole() const {
    cv::Mat whole = cv::Mat::zeros(mask.size(), CV_8UC1);
    whole(plate).setTo(255);
    return whole;
  }
};

MaskGrowth Far() { return {100, 100000, 0.05F, {0.5F, 3.0F}, {}}; }

TEST(MaskGrowth, FillsTheSurfaceAndStopsAtItsEdge) {
  Plate scene;
  GrowAlongDepth(scene.depth_m, Far(), scene.mask);
  EXPECT_EQ(cv::countNonZero(scene.mask != scene.Whole()), 0);
}

TEST(MaskGrowth, GoesNoFartherThanTold) {
  Plate scene;
  MaskGrowth growth = Far();
  growth.distance_px = 3;
  GrowAlongDepth(scene.depth_m, growth, scene.mask);
  EXPECT_EQ(scene.mask.at<std::uint8_t>(30, 27), 255);
  EXPECT_EQ(scene.mask.at<std::uint8_t>(30, 26), 0);
}

TEST(MaskGrowth, StopsWhenEnoughIsAdded) {
  Plate scene;
  const int before = cv::countNonZero(scene.mask);
  MaskGrowth growth = Far();
  growth.max_added = 50;
  GrowAlongDepth(scene.depth_m, growth, scene.mask);
  const int added = cv::countNonZero(scene.mask) - before;
  EXPECT_GE(added, 50);
  EXPECT_LT(added, 50 + 60) << "a ring more at most";
}

TEST(MaskGrowth, StaysInTheRangeThoughTheSurfaceGoesOn) {
  Plate scene;
  for (int x = 0; x < 80; ++x) scene.depth_m.col(x).setTo(1 + 0.02F * static_cast<float>(x));
  MaskGrowth growth = Far();
  growth.range = {1.5F, 1.9F};
  GrowAlongDepth(scene.depth_m, growth, scene.mask);
  EXPECT_EQ(scene.mask.at<std::uint8_t>(30, 44), 255);
  EXPECT_EQ(scene.mask.at<std::uint8_t>(30, 47), 0);
}

TEST(MaskGrowth, DoesNotGoWhereNothingWasMeasured) {
  Plate scene;
  scene.depth_m(cv::Rect(45, 0, 5, 60)).setTo(0);
  GrowAlongDepth(scene.depth_m, Far(), scene.mask);
  EXPECT_EQ(scene.mask.at<std::uint8_t>(30, 44), 255);
  EXPECT_EQ(scene.mask.at<std::uint8_t>(30, 47), 0);
  EXPECT_EQ(scene.mask.at<std::uint8_t>(30, 55), 0);
}

TEST(MaskGrowth, WhatIsFreeKnowsNoLimit) {
  Plate scene;
  MaskGrowth growth = Far();
  growth.distance_px = 0;
  growth.max_added = 0;
  growth.free = cv::Mat::zeros(scene.mask.size(), CV_8UC1);
  growth.free(cv::Rect(40, 0, 40, 60)).setTo(255);
  GrowAlongDepth(scene.depth_m, growth, scene.mask);
  EXPECT_EQ(scene.mask.at<std::uint8_t>(30, 59), 255) << "to the plate's edge";
  EXPECT_EQ(scene.mask.at<std::uint8_t>(30, 60), 0) << "not to the wall";
  EXPECT_EQ(scene.mask.at<std::uint8_t>(30, 29), 0) << "nor where it is not free";
}

}  // namespace
}  // namespace ofm
