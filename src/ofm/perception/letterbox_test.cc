#include "ofm/perception/letterbox.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace ofm {
namespace {

TEST(Letterbox, ImageOfTheInputsSizeIsTakenAsItIs) {
  const Letterbox letterbox = MakeLetterbox({640, 480}, {640, 480});
  EXPECT_EQ(letterbox.resized, cv::Size(640, 480));
  EXPECT_EQ(letterbox.upper_left, cv::Point(0, 0));
  EXPECT_DOUBLE_EQ(letterbox.ImageX(123.25), 123.25);
}

TEST(Letterbox, WideInputGetsBordersAtTheSides) {
  const Letterbox letterbox = MakeLetterbox({640, 480}, {640, 320});
  EXPECT_EQ(letterbox.resized, cv::Size(427, 320));
  EXPECT_EQ(letterbox.upper_left, cv::Point(106, 0));
}

TEST(Letterbox, HighInputGetsBordersAboveAndBelow) {
  const Letterbox letterbox = MakeLetterbox({640, 480}, {320, 256});
  EXPECT_EQ(letterbox.resized, cv::Size(320, 240));
  EXPECT_EQ(letterbox.upper_left, cv::Point(0, 8));
  EXPECT_DOUBLE_EQ(letterbox.ImageY(8), 0);
  EXPECT_DOUBLE_EQ(letterbox.ImageY(248), 480);
}

TEST(Letterbox, WayBackUndoesTheRoundedScaleExactly) {
  const Letterbox letterbox = MakeLetterbox({641, 479}, {511, 383});
  EXPECT_DOUBLE_EQ(letterbox.ImageX(letterbox.upper_left.x), 0);
  EXPECT_DOUBLE_EQ(letterbox.ImageX(letterbox.upper_left.x + letterbox.resized.width), 641);
  EXPECT_DOUBLE_EQ(letterbox.ImageY(letterbox.upper_left.y + letterbox.resized.height), 479);
  for (const double x : {0.0, 0.5, 17.25, 640.0}) {
    EXPECT_NEAR(letterbox.ImageX(letterbox.InputX(x)), x, 1e-9);
    EXPECT_NEAR(letterbox.ImageY(letterbox.InputY(x)), x, 1e-9);
  }
}

TEST(Letterbox, NarrowImageKeepsAtLeastOnePixel) {
  const Letterbox letterbox = MakeLetterbox({1000, 1}, {64, 64});
  EXPECT_EQ(letterbox.resized, cv::Size(64, 1));
}

/// The image's brightness tells the place: each pixel of the input must show what the geometry
/// says.
TEST(Letterbox, PixelsAreWhereTheGeometrySays) {
  cv::Mat image(60, 80, CV_8UC3);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x)
      image.at<cv::Vec3b>(y, x) = cv::Vec3b(3 * x, 4 * y, 240 - 3 * x);
  }
  for (const cv::Size input : {cv::Size(120, 100), cv::Size(61, 47)}) {
    const Letterbox letterbox = MakeLetterbox(image.size(), input);
    const cv::Mat boxed = ApplyLetterbox(letterbox, image);
    ASSERT_EQ(boxed.size(), input);
    cv::Rect inner(letterbox.upper_left + cv::Point(2, 2), letterbox.resized - cv::Size(4, 4));
    double sum = 0;
    for (int y = inner.y; y < inner.br().y; ++y) {
      for (int x = inner.x; x < inner.br().x; ++x) {
        const cv::Vec3b value = boxed.at<cv::Vec3b>(y, x);
        const double error_x = value[0] / 3.0 - (letterbox.ImageX(x + 0.5) - 0.5);
        const double error_y = value[1] / 4.0 - (letterbox.ImageY(y + 0.5) - 0.5);
        // One grey level of rounding is 1/3 px in x and 1/4 px in y; it averages out.
        ASSERT_LE(std::abs(error_x), 1 / 3.0);
        ASSERT_LE(std::abs(error_y), 1 / 4.0);
        // Rounding that prefers one side does so in the falling channel, too.
        sum += (value[0] - value[2] + 240) / 6.0 - (letterbox.ImageX(x + 0.5) - 0.5);
      }
    }
    EXPECT_NEAR(sum / inner.area(), 0, 0.01);
  }
}

TEST(Letterbox, BordersAreGrey) {
  const cv::Mat white(48, 64, CV_8UC3, cv::Scalar::all(255));
  const cv::Mat boxed = ApplyLetterbox(MakeLetterbox({64, 48}, {64, 64}), white);
  EXPECT_EQ(boxed.at<cv::Vec3b>(7, 30), cv::Vec3b(114, 114, 114));
  EXPECT_EQ(boxed.at<cv::Vec3b>(8, 30), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(boxed.at<cv::Vec3b>(55, 30), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(boxed.at<cv::Vec3b>(56, 30), cv::Vec3b(114, 114, 114));
}

TEST(Letterbox, EmptySizeIsAProgrammersError) {
  EXPECT_THROW(MakeLetterbox({0, 0}, {64, 64}), std::logic_error);
}

}  // namespace
}  // namespace ofm
