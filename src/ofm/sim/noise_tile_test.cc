#include "ofm/sim/noise_tile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

namespace ofm {
namespace {

TEST(NoiseTile, IsBoundedAndVaries) {
  RandomEngine engine = MakeRandomEngine(1, 0);
  const cv::Mat noise = MakeNoiseTile(engine, 64, {4, 4, 3});
  cv::Scalar mean, deviation;
  cv::meanStdDev(noise, mean, deviation);
  EXPECT_NEAR(mean[0], 0, 0.25);
  EXPECT_GT(deviation[0], 0.1);
  EXPECT_LT(cv::norm(noise, cv::NORM_INF), 1.6);
}

TEST(NoiseTile, EdgesMeet) {
  RandomEngine engine = MakeRandomEngine(2, 0);
  const cv::Mat noise = MakeNoiseTile(engine, 64, {4, 2, 1});
  EXPECT_LT(cv::norm(noise.row(0), noise.row(63), cv::NORM_INF), 0.15);
  EXPECT_LT(cv::norm(noise.col(0), noise.col(63), cv::NORM_INF), 0.15);
}

TEST(NoiseTile, ShadeTileAddsTheNoiseToAColor) {
  const cv::Mat noise = (cv::Mat_<float>(1, 2) << 0.5F, -1.0F);
  const cv::Mat tile = ShadeTile({100, 50, 10}, noise, 20);
  EXPECT_EQ(tile.at<cv::Vec3b>(0, 0), cv::Vec3b(110, 60, 20));
  EXPECT_EQ(tile.at<cv::Vec3b>(0, 1), cv::Vec3b(80, 30, 0));
}

TEST(NoiseTile, DrawsStayWithinTheirBounds) {
  RandomEngine engine = MakeRandomEngine(3, 0);
  for (int i = 0; i < 50; ++i) {
    const double value = UniformBetween(engine, -2, 5);
    EXPECT_GE(value, -2);
    EXPECT_LT(value, 5);
    const cv::Scalar varied = VaryColor(engine, {100, 100, 100}, 10);
    EXPECT_NEAR(varied[1], 100, 10);
    EXPECT_EQ(varied[0], varied[2]);
    const cv::Scalar hue = RandomHue(engine);
    EXPECT_GT(std::max({hue[0], hue[1], hue[2]}) - std::min({hue[0], hue[1], hue[2]}), 15);
  }
}

}  // namespace
}  // namespace ofm
