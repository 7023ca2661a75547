#include "ofm/features/patch_alignment.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "ofm/features/test_images.h"

namespace ofm {
namespace {

constexpr int kMiddle = 60;

/// The patch about pixel (kMiddle, kMiddle).
ImagePatch MiddlePatch(const cv::Mat& image) {
  ImagePatch patch;
  for (int y = 0; y < ImagePatch::kSize; ++y) {
    for (int x = 0; x < ImagePatch::kSize; ++x) {
      patch.gray[y * ImagePatch::kSize + x] = image.at<std::uint8_t>(
          kMiddle + y - ImagePatch::kRadius, kMiddle + x - ImagePatch::kRadius);
    }
  }
  return patch;
}

/// A corner in the middle of others, coarse enough that a bilinear warp of it is exact to a grey
/// level or so.
cv::Mat SoftTexture() {
  cv::Mat image = TexturedImage(2 * kMiddle + 1, 2 * kMiddle + 1);
  image(cv::Rect(kMiddle, kMiddle, 14, 11)).setTo(230);
  image(cv::Rect(kMiddle - 9, kMiddle - 12, 9, 12)).setTo(30);
  cv::GaussianBlur(image, image, {}, 1.6);
  return image;
}

/// `image` turned and scaled about its middle, and shifted: what lay in the middle is then there.
/// OpenCV takes places to 1/32 px, and so do the shifts.
cv::Mat Move(const cv::Mat& image, double angle_rad, double scale, const Eigen::Vector2d& shift) {
  const double c = scale * std::cos(angle_rad), s = scale * std::sin(angle_rad);
  const cv::Matx23d warp(c, -s, kMiddle - c * kMiddle + s * kMiddle + shift.x(),  //
                         s, c, kMiddle - s * kMiddle - c * kMiddle + shift.y());
  cv::Mat moved;
  cv::warpAffine(image, moved, warp, image.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  return moved;
}

std::optional<Eigen::Vector2f> Align(const ImagePatch& reference, const ImagePatch& current,
                                     const Eigen::Matrix2f& reference_from_current,
                                     const PatchAlignmentOptions& options = {}) {
  return AlignPatch({reference, Eigen::Vector2f::Zero()}, {current, Eigen::Vector2f::Zero()},
                    reference_from_current, options);
}

std::optional<Eigen::Vector2f> AlignShifted(const Eigen::Vector2d& shift,
                                            const PatchAlignmentOptions& options = {}) {
  const cv::Mat image = SoftTexture();
  return Align(MiddlePatch(image), MiddlePatch(Move(image, 0, 1, shift)),
               Eigen::Matrix2f::Identity(), options);
}

TEST(AlignPatch, FindsAShiftToLessThanATenthOfAPixel) {
  for (const Eigen::Vector2d& shift : {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.3125, -0.625),
                                       Eigen::Vector2d(-1.1875, 0.90625)}) {
    const auto offset = AlignShifted(shift);
    ASSERT_TRUE(offset.has_value()) << shift.transpose();
    EXPECT_LT((offset->cast<double>() - shift).norm(), 0.07) << shift.transpose();
  }
}

TEST(AlignPatch, AllowsForTurnAndScale) {
  const cv::Mat image = SoftTexture();
  const double angle = 0.3, scale = 1.15;
  const Eigen::Vector2d shift(0.4, -0.7);
  const auto offset =
      Align(MiddlePatch(image), MiddlePatch(Move(image, angle, scale, shift)),
            (Eigen::Rotation2D<float>(static_cast<float>(-angle)).toRotationMatrix() / scale)
                .cast<float>());
  ASSERT_TRUE(offset.has_value());
  EXPECT_LT((offset->cast<double>() - shift).norm(), 0.08);
}

TEST(AlignPatch, LooksForTheReferencesOwnPlace) {
  const cv::Mat image = SoftTexture();
  const Eigen::Vector2f place(0.4F, 0.2F);
  const ImagePatch patch = MiddlePatch(image);
  const auto offset =
      AlignPatch({patch, place}, {patch, Eigen::Vector2f::Zero()}, Eigen::Matrix2f::Identity(), {});
  ASSERT_TRUE(offset.has_value());
  EXPECT_LT((*offset - place).norm(), 0.02);
}

TEST(AlignPatch, DoesNotMindExposure) {
  const cv::Mat image = SoftTexture();
  const Eigen::Vector2d shift(0.5, 0.25);
  cv::Mat dark;
  Move(image, 0, 1, shift).convertTo(dark, CV_8UC1, 0.6, 15);
  const auto offset = Align(MiddlePatch(image), MiddlePatch(dark), Eigen::Matrix2f::Identity());
  ASSERT_TRUE(offset.has_value());
  EXPECT_LT((offset->cast<double>() - shift).norm(), 0.07);
}

TEST(AlignPatch, RefusesAnotherPlacesSurroundings) {
  int found = 0;
  for (std::uint64_t seed = 2; seed < 12; ++seed) {
    const cv::Mat other = TexturedImage(2 * kMiddle + 1, 2 * kMiddle + 1, seed);
    found += Align(MiddlePatch(SoftTexture()), MiddlePatch(other), Eigen::Matrix2f::Identity())
                 .has_value();
  }
  EXPECT_EQ(found, 0);
}

TEST(AlignPatch, RefusesWhatShowsNoCorner) {
  cv::Mat edge(2 * kMiddle + 1, 2 * kMiddle + 1, CV_8UC1, cv::Scalar(60));
  edge(cv::Rect(kMiddle, 0, kMiddle + 1, 2 * kMiddle + 1)).setTo(180);
  const ImagePatch patch = MiddlePatch(edge);
  EXPECT_FALSE(Align(patch, patch, Eigen::Matrix2f::Identity()).has_value());
  EXPECT_FALSE(Align({}, {}, Eigen::Matrix2f::Identity()).has_value());
}

TEST(AlignPatch, MovesNoFurtherThanAllowed) {
  PatchAlignmentOptions options;
  options.max_shift_px = 0.5;
  EXPECT_FALSE(AlignShifted({1.0, 0.0}, options).has_value());
  EXPECT_TRUE(AlignShifted({0.3, 0.0}, options).has_value());
}

TEST(AlignPatch, RefusesAWarpThatLeavesThePatch) {
  const ImagePatch patch = MiddlePatch(SoftTexture());
  EXPECT_FALSE(Align(patch, patch, 3 * Eigen::Matrix2f::Identity()).has_value());
}

TEST(AlignPatch, RefusesPatchesThatShowWhatIsExcluded) {
  const ImagePatch whole = MiddlePatch(SoftTexture());
  ImagePatch partial = whole;
  partial.is_whole = false;
  EXPECT_FALSE(Align(partial, whole, Eigen::Matrix2f::Identity()).has_value());
  EXPECT_FALSE(Align(whole, partial, Eigen::Matrix2f::Identity()).has_value());
}

TEST(ImagePatch, GrayIsInterpolatedAndNegativeOutside) {
  ImagePatch patch;
  patch.gray[ImagePatch::kRadius * ImagePatch::kSize + ImagePatch::kRadius] = 100;
  EXPECT_FLOAT_EQ(patch.At({0, 0}), 100);
  EXPECT_FLOAT_EQ(patch.At({0.5F, 0}), 50);
  EXPECT_FLOAT_EQ(patch.At({0.5F, -0.5F}), 25);
  EXPECT_LT(patch.At({ImagePatch::kRadius + 0.5F, 0}), 0);
  EXPECT_LT(patch.At({0, -ImagePatch::kRadius - 0.5F}), 0);
}

}  // namespace
}  // namespace ofm
