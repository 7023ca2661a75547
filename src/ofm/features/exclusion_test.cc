#include "ofm/features/exclusion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace ofm {
namespace {

/// 8 x 6 pixels of which column 3 is excluded.
cv::Mat ColumnThree() {
  cv::Mat excluded = cv::Mat::zeros(6, 8, CV_8UC1);
  excluded.col(3) = 1;
  return excluded;
}

/// Features in row 2; the descriptor's first word is the feature's number.
Features InRowTwo(const std::vector<float>& columns) {
  Features features;
  for (const float x : columns) {
    features.descriptors.push_back({features.size(), 0, 0, 0});
    features.keypoints.push_back({.pixel = {x, 2}});
  }
  return features;
}

TEST(IsExcluded, GoesByTheNearestPixel) {
  const cv::Mat excluded = ColumnThree();
  EXPECT_FALSE(IsExcluded(excluded, {2.4F, 2}));
  EXPECT_TRUE(IsExcluded(excluded, {2.6F, 2}));
  EXPECT_TRUE(IsExcluded(excluded, {3.4F, 5.4F}));
  EXPECT_FALSE(IsExcluded(excluded, {3.6F, 2}));
  EXPECT_TRUE(IsExcluded(excluded, {3, 99})) << "off the image: its border's";
  EXPECT_FALSE(IsExcluded({}, {3, 2}));
}

TEST(EraseExcluded, KeepsTheOthersInTheirOrderWithTheirDescriptors) {
  Features features = InRowTwo({0, 3, 5, 3, 7});
  EraseExcluded(ColumnThree(), features);
  std::vector<std::uint64_t> numbers;
  for (const Descriptor& descriptor : features.descriptors) numbers.push_back(descriptor[0]);
  EXPECT_THAT(numbers, testing::ElementsAre(0, 2, 4));
  ASSERT_EQ(features.keypoints.size(), 3U);
  EXPECT_EQ(features.keypoints[1].pixel.x(), 5);
}

TEST(EraseExcluded, KeepsTheOthersPatches) {
  Features features = InRowTwo({0, 3, 5});
  features.patches.resize(3);
  for (int i = 0; i < 3; ++i) features.patches[i].gray[0] = static_cast<std::uint8_t>(i);
  EraseExcluded(ColumnThree(), features);
  ASSERT_EQ(features.patches.size(), 2U);
  EXPECT_EQ(features.patches[1].gray[0], 2);
}

TEST(EraseExcluded, AnEmptyMaskKeepsAll) {
  Features features = InRowTwo({0, 3});
  EraseExcluded({}, features);
  EXPECT_EQ(features.size(), 2U);
}

TEST(EraseExcluded, RefusesAMaskOfAnotherType) {
  Features features = InRowTwo({0});
  EXPECT_THROW(EraseExcluded(cv::Mat::zeros(6, 8, CV_32FC1), features), std::logic_error);
}

}  // namespace
}  // namespace ofm
