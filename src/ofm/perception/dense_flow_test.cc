#include "ofm/perception/dense_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

#include "ofm/perception/test_support.h"

namespace ofm {
namespace {

const cv::Size kSize(160, 120);

/// The image moved by `shift` [px].
cv::Mat Shifted(const cv::Mat& image, cv::Point2d shift) {
  const cv::Mat transform = (cv::Mat_<double>(2, 3) << 1, 0, shift.x, 0, 1, shift.y);
  cv::Mat moved;
  cv::warpAffine(image, moved, transform, image.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT_101);
  return moved;
}

/// Share of the pixels in `area` whose flow is `truth` within `tolerance_px`.
double ShareRight(const cv::Mat& flow, const cv::Rect& area, cv::Point2d truth,
                  double tolerance_px) {
  int right = 0;
  for (int y = area.y; y < area.br().y; ++y) {
    for (int x = area.x; x < area.br().x; ++x) {
      const cv::Vec2f v = flow.at<cv::Vec2f>(y, x);
      right += std::hypot(v[0] - truth.x, v[1] - truth.y) < tolerance_px;
    }
  }
  return right / static_cast<double>(area.area());
}

TEST(DenseFlow, FindsTheShiftOfATextureEverywhere) {
  const cv::Mat image = test::MakeTexture(kSize, 1);
  DenseFlow dense_flow;
  const cv::Rect inside(16, 16, kSize.width - 32, kSize.height - 32);
  for (const cv::Point2d shift : {cv::Point2d(0, 0), cv::Point2d(1.5, -0.75), cv::Point2d(-6, 4)}) {
    const cv::Mat flow = dense_flow.Compute(image, Shifted(image, shift));
    ASSERT_EQ(flow.size(), kSize);
    ASSERT_EQ(flow.type(), CV_32FC2);
    EXPECT_GT(ShareRight(flow, inside, shift, 0.5), 0.95) << shift;
  }
}

TEST(DenseFlow, PartThatMovesOtherwiseHasItsOwnFlow) {
  const cv::Mat background = test::MakeTexture(kSize, 2);
  const cv::Mat object = test::MakeTexture({48, 60}, 3);
  cv::Mat from = background.clone(), to = Shifted(background, {-1, 0});
  object.copyTo(from(cv::Rect(50, 30, 48, 60)));
  object.copyTo(to(cv::Rect(55, 32, 48, 60)));
  const cv::Mat flow = DenseFlow().Compute(from, to);
  EXPECT_GT(ShareRight(flow, {58, 38, 32, 44}, {5, 2}, 1), 0.9);
  EXPECT_GT(ShareRight(flow, {112, 16, 32, 88}, {-1, 0}, 0.5), 0.9);
}

TEST(DenseFlow, ImageWithoutTextureHasFiniteFlow) {
  const cv::Mat flat(kSize, CV_8UC1, cv::Scalar(90));
  const cv::Mat flow = DenseFlow().Compute(flat, flat);
  EXPECT_TRUE(cv::checkRange(flow));
  EXPECT_LT(cv::norm(flow, cv::NORM_INF), 0.5);
}

TEST(DenseFlow, ObjectThatWasUsedBeforeGivesTheSameFlow) {
  const cv::Mat a = test::MakeTexture(kSize, 4), b = Shifted(a, {3, 1});
  DenseFlow used, fresh;
  used.Compute(b, test::MakeTexture(kSize, 5));
  used.Compute(test::MakeTexture({64, 48}, 6), test::MakeTexture({64, 48}, 7));
  cv::setNumThreads(1);
  EXPECT_EQ(cv::norm(used.Compute(a, b), fresh.Compute(a, b), cv::NORM_INF), 0);
}

TEST(DenseFlow, TinyImagesGiveNoFlow) {
  DenseFlow dense_flow;
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(16, 64), cv::Size(64, 31)}) {
    const cv::Mat image = cv::Mat::zeros(size, CV_8UC1);
    EXPECT_TRUE(dense_flow.Compute(image, image).empty()) << size;
  }
  const cv::Mat least = test::MakeTexture({32, 32}, 8);
  EXPECT_EQ(dense_flow.Compute(least, least).size(), cv::Size(32, 32));
}

TEST(DenseFlow, RefusesImagesOfOtherTypesAndSizes) {
  const cv::Mat gray = cv::Mat::zeros(kSize, CV_8UC1), color = cv::Mat::zeros(kSize, CV_8UC3);
  const cv::Mat smaller = cv::Mat::zeros(64, 64, CV_8UC1);
  EXPECT_THROW(DenseFlow().Compute(color, color), std::logic_error);
  EXPECT_THROW(DenseFlow().Compute(gray, color), std::logic_error);
  EXPECT_THROW(DenseFlow().Compute(gray, smaller), std::logic_error);
}

}  // namespace
}  // namespace ofm
