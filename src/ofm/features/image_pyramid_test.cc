#include "ofm/features/image_pyramid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "ofm/features/test_images.h"

namespace ofm {
namespace {

/// A plane of grey values at the places of the full image's pixels.
double RampAt(double x, double y) { return 20 + 0.5 * x + 0.3 * y; }

cv::Mat RampImage(int width, int height) {
  cv::Mat image(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(RampAt(x, y));
    }
  }
  return image;
}

cv::Mat ToMat(const PaddedImage& image) {
  cv::Mat mat(image.height(), image.width(), CV_8UC1);
  for (int y = 0; y < mat.rows; ++y) std::copy_n(image.Row(y), mat.cols, mat.ptr(y));
  return mat;
}

TEST(ImagePyramid, LevelsShrinkByTheScaleFactor) {
  ImagePyramid pyramid(8, 1.2, BestOrbKernels());
  pyramid.Build(TexturedImage(640, 480));
  ASSERT_EQ(pyramid.levels(), 8);
  EXPECT_EQ(pyramid.image(0).width(), 640);
  EXPECT_EQ(pyramid.image(1).width(), 533);
  EXPECT_EQ(pyramid.image(7).width(), 179);
  EXPECT_EQ(pyramid.image(7).height(), 134);
}

TEST(ImagePyramid, LevelZeroIsTheImageUnderABinomialFilter) {
  const cv::Mat image = NoiseImage(101, 37);
  ImagePyramid pyramid(2, 1.2, BestOrbKernels());
  pyramid.Build(image);
  const cv::Mat weights = (cv::Mat_<float>(1, 3) << 0.25f, 0.5f, 0.25f);
  cv::Mat expected;
  cv::sepFilter2D(image, expected, CV_32F, weights, weights, {-1, -1}, 0, cv::BORDER_REPLICATE);
  cv::Mat actual;
  ToMat(pyramid.image(0)).convertTo(actual, CV_32F);
  EXPECT_LE(cv::norm(actual, expected, cv::NORM_INF), 0.5);
}

TEST(ImagePyramid, PixelsOfALevelLieWhereTheirCentresAreInTheFullImage) {
  for (const double factor : {1.2, 1.5, 2.0}) {
    ImagePyramid pyramid(4, factor, BestOrbKernels());
    pyramid.Build(RampImage(300, 200));
    for (int level = 1; level < 4; ++level) {
      const double scale = std::pow(factor, level);
      const PaddedImage& image = pyramid.image(level);
      for (int y = 1; y < image.height() - 1; y += 3) {
        for (int x = 1; x < image.width() - 1; x += 3) {
          const double expected = RampAt((x + 0.5) * scale - 0.5, (y + 0.5) * scale - 0.5);
          ASSERT_NEAR(image.Row(y)[x], expected, 1.6) << factor << " " << level;
        }
      }
    }
  }
}

TEST(ImagePyramid, SmoothingIsAGaussianOfSigmaTwo) {
  ImagePyramid pyramid(1, 1.2, BestOrbKernels());
  const cv::Mat image = NoiseImage(90, 70);
  pyramid.Build(image);
  pyramid.Smooth(0);
  cv::Mat expected;
  cv::GaussianBlur(ToMat(pyramid.image(0)), expected, {7, 7}, 2, 2, cv::BORDER_REPLICATE);
  EXPECT_LE(cv::norm(ToMat(pyramid.smooth(0)), expected, cv::NORM_INF), 4);
}

TEST(ImagePyramid, TinyImagesHaveFewerLevels) {
  ImagePyramid pyramid(8, 2, BestOrbKernels());
  pyramid.Build(cv::Mat(5, 9, CV_8UC1, cv::Scalar(7)));
  EXPECT_EQ(pyramid.levels(), 4);  // heights 5, 3 (2.5), 1, 1 (0.6)
  EXPECT_EQ(pyramid.image(3).Row(0)[0], 7);
}

TEST(ImagePyramid, ASmallerImageAfterALargerOneIsAsGoodAsNew) {
  const cv::Mat large = TexturedImage(320, 240), small = TexturedImage(200, 150);
  ImagePyramid used(4, 1.2, BestOrbKernels()), fresh(4, 1.2, BestOrbKernels());
  used.Build(large);
  used.Build(small);
  fresh.Build(small);
  EXPECT_EQ(cv::norm(ToMat(used.image(3)), ToMat(fresh.image(3)), cv::NORM_INF), 0);
}

}  // namespace
}  // namespace ofm
