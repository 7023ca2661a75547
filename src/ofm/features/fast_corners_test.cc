#include "ofm/features/fast_corners.h"

#include <gmock/gmock.h>

#include "ofm/features/test_images.h"

namespace ofm {
namespace {

PaddedImage ToPadded(const cv::Mat& mat) {
  PaddedImage image;
  image.Resize(mat.cols, mat.rows);
  for (int y = 0; y < mat.rows; ++y) std::copy_n(mat.ptr(y), mat.cols, image.Row(y));
  return image;
}

/// Dark, with a bright pixel at (20, 12).
cv::Mat DotImage() {
  cv::Mat mat(30, 40, CV_8UC1, cv::Scalar(50));
  mat.at<std::uint8_t>(12, 20) = 150;
  return mat;
}

TEST(FastDetector, FindsADotWithItsContrastAsScore) {
  FastDetector detector(BestOrbKernels());
  EXPECT_THAT(detector.Detect(ToPadded(DotImage()), 20, 4),
              ::testing::ElementsAre(Corner{20, 12, 100}));
  EXPECT_EQ(detector.RefinedOffset({20, 12, 100}), Eigen::Vector2f(0, 0));
}

TEST(FastDetector, TheScoreMustBeOverTheThreshold) {
  FastDetector detector(BestOrbKernels());
  EXPECT_EQ(detector.Detect(ToPadded(DotImage()), 99, 4).size(), 1u);
  EXPECT_EQ(detector.Detect(ToPadded(DotImage()), 100, 4).size(), 0u);
}

TEST(FastDetector, LeavesTheMarginOut) {
  FastDetector detector(BestOrbKernels());
  EXPECT_EQ(detector.Detect(ToPadded(DotImage()), 20, 12).size(), 1u);
  EXPECT_EQ(detector.Detect(ToPadded(DotImage()), 20, 13).size(), 0u);
  EXPECT_EQ(detector.Detect(ToPadded(DotImage()), 20, 20).size(), 0u);
}

TEST(FastDetector, CornersDoNotTouch) {
  FastDetector detector(BestOrbKernels());
  const std::vector<Corner> corners = detector.Detect(ToPadded(NoiseImage(120, 90)), 7, 4);
  ASSERT_GT(corners.size(), 100u);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const int distance =
          std::max(std::abs(corners[i].x - corners[j].x), std::abs(corners[i].y - corners[j].y));
      ASSERT_GT(distance, 1);
    }
  }
}

TEST(FastDetector, TheOffsetLeansToTheStrongerSide) {
  cv::Mat mat = DotImage();
  mat.at<std::uint8_t>(12, 21) = 110;
  FastDetector detector(BestOrbKernels());
  const std::vector<Corner> corners = detector.Detect(ToPadded(mat), 20, 4);
  ASSERT_EQ(corners.size(), 1u);
  const Eigen::Vector2f offset = detector.RefinedOffset(corners[0]);
  EXPECT_NEAR(offset.x(), 0.21f, 0.01f);  // parabola through 0, 100 and 60: 60 / (2 * 140)
  EXPECT_EQ(offset.y(), 0);
}

TEST(FastDetector, RejectsAMarginThatItsCircleLeaves) {
  FastDetector detector(BestOrbKernels());
  EXPECT_THROW(detector.Detect(ToPadded(DotImage()), 20, 3), std::logic_error);
}

}  // namespace
}  // namespace ofm
