#include "ofm/dense/inpainting_metrics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ofm {
namespace {

/// Ten by ten pixels, 2 m away, grey; actors hid the left half.
struct Frame {
  cv::Mat color{10, 10, CV_8UC3, cv::Scalar::all(100)};
  cv::Mat depth_m{10, 10, CV_32FC1, cv::Scalar(2)};
};

cv::Mat LeftHalf() {
  cv::Mat actors = cv::Mat::zeros(10, 10, CV_8UC1);
  actors.colRange(0, 5) = 7;
  return actors;
}

InpaintingMetrics Measure(const Frame& frame) {
  InpaintingMeter meter;
  const Frame truth;
  meter.AddFrame(frame.color, frame.depth_m, LeftHalf(), truth.color, truth.depth_m);
  return meter.metrics();
}

TEST(InpaintingMeter, ThePerfectFrameHasNoError) {
  const InpaintingMetrics metrics = Measure({});
  EXPECT_EQ(metrics.hidden_pixels, 50U);
  EXPECT_EQ(metrics.filled_share, 1);
  EXPECT_EQ(metrics.median_depth_error_m, 0);
  EXPECT_TRUE(std::isinf(metrics.psnr_db));
}

TEST(InpaintingMeter, CountsWhatWasNotFilled) {
  Frame frame;
  frame.depth_m.colRange(0, 2) = 0;
  frame.color.colRange(0, 2).setTo(0);
  const InpaintingMetrics metrics = Measure(frame);
  EXPECT_EQ(metrics.filled_pixels, 30U);
  EXPECT_DOUBLE_EQ(metrics.filled_share, .6);
  EXPECT_TRUE(std::isinf(metrics.psnr_db)) << "of what was filled";
}

TEST(InpaintingMeter, ErrorsAreThoseOfTheHiddenPixels) {
  Frame frame;
  frame.depth_m.colRange(0, 5) = 2.25;
  frame.color.colRange(0, 5).setTo(cv::Scalar::all(110));
  frame.depth_m.colRange(5, 10) = 9;
  frame.color.colRange(5, 10).setTo(cv::Scalar::all(255));
  const InpaintingMetrics metrics = Measure(frame);
  EXPECT_DOUBLE_EQ(metrics.median_depth_error_m, .25);
  EXPECT_NEAR(metrics.psnr_db, 10 * std::log10(255. * 255 / 100), 1e-9);
}

TEST(InpaintingMeter, OfNothingThereIsNoError) {
  const InpaintingMetrics metrics = InpaintingMeter().metrics();
  EXPECT_EQ(metrics.filled_share, 0);
  EXPECT_TRUE(std::isnan(metrics.median_depth_error_m));
}

}  // namespace
}  // namespace ofm
