#include "ofm/sim/imaging.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

namespace ofm {
namespace {

/// A row on which a white pixel goes right by 1 px in each hundredth of a second.
cv::Mat MovingDot(double time_s) {
  cv::Mat image = cv::Mat::zeros(1, 32, CV_8UC3);
  image.at<cv::Vec3b>(0, 16 + static_cast<int>(std::lround(100 * time_s))) = {255, 255, 255};
  return image;
}

TEST(BlurByMotion, SpreadsWhatMovesOverItsWayAboutTheStamp) {
  ImagingOptions options;
  options.exposure_s = 0.04;
  options.sub_frame_px = 1;
  std::vector<double> times;
  const cv::Mat blurred = BlurByMotion(options, 0, 100, [&times](double time_s) {
    times.push_back(time_s);
    return MovingDot(time_s + 1e-9);
  });
  ASSERT_EQ(times.size(), 4U);
  EXPECT_NEAR(times[0], -0.015, 1e-12);
  EXPECT_NEAR(times[3], 0.015, 1e-12);
  EXPECT_NEAR(cv::sum(blurred)[0], 255, 4);
  EXPECT_EQ(cv::countNonZero(blurred.reshape(1) > 32), 3 * 4);
}

TEST(BlurByMotion, SlowMotionTakesOneImageAndFastMotionNoMoreThanAllowed) {
  ImagingOptions options;
  options.exposure_s = 0.01;
  int images = 0;
  const auto render = [&images](double time_s) {
    ++images;
    return MovingDot(time_s);
  };
  BlurByMotion(options, 0, 10, render);
  EXPECT_EQ(images, 1);
  images = 0;
  BlurByMotion(options, 0, 1e5, render);
  EXPECT_EQ(images, options.max_sub_frames);
}

TEST(ChangeExposure, GoesUpAndDownByTheStopsAndSaturates) {
  ImagingOptions options;
  options.exposure_swing = 1;
  double least = 1e9, most = 0;
  for (double t = 0; t < 30; t += 0.1) {
    cv::Mat image(2, 2, CV_8UC3, cv::Scalar(100, 200, 0));
    ChangeExposure(options, t, image);
    const cv::Vec3b pixel = image.at<cv::Vec3b>(0, 0);
    least = std::min(least, double(pixel[0]));
    most = std::max(most, double(pixel[0]));
    EXPECT_EQ(pixel[2], 0);
  }
  EXPECT_GE(least, 50);
  EXPECT_LT(least, 60);
  EXPECT_LE(most, 200);
  EXPECT_GT(most, 170);
}

TEST(ChangeExposure, DoesNothingByDefault) {
  cv::Mat image(1, 1, CV_8UC3, cv::Scalar(7, 8, 9));
  ChangeExposure({}, 3, image);
  EXPECT_EQ(image.at<cv::Vec3b>(0, 0), cv::Vec3b(7, 8, 9));
}

}  // namespace
}  // namespace ofm
