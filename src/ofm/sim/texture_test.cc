#include "ofm/sim/texture.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "ofm/base/random.h"

namespace ofm {
namespace {

TextureOptions SmallTile(TextureStyle style = TextureStyle::kPatches) {
  TextureOptions options;
  options.style = style;
  options.size_px = 128;
  options.metres_per_texel = 0.01;
  return options;
}

Eigen::Array3f Texel(const Texture& texture, int column, int row) {
  const cv::Vec4b pixel = texture.image().at<cv::Vec4b>(row, column);
  return {float(pixel[0]), float(pixel[1]), float(pixel[2])};
}

/// Share of the tile where the structure tensor's smaller eigenvalue is that of a corner.
double CornerShare(const Texture& texture) {
  cv::Mat gray, strength;
  cv::cvtColor(texture.image(), gray, cv::COLOR_BGRA2GRAY);
  cv::cornerMinEigenVal(gray, strength, 3);
  return cv::countNonZero(strength > 1e-3) / static_cast<double>(strength.total());
}

TEST(Texture, SameSeedGivesSameTileAndAnotherSeedAnother) {
  const Texture a(SmallTile(), 1), same(SmallTile(), 1), other(SmallTile(), 2);
  EXPECT_EQ(cv::norm(a.image(), same.image(), cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(a.image(), other.image(), cv::NORM_L1) / a.image().total(), 20);
}

TEST(Texture, TexelCentreHasTheTexelsColor) {
  const Texture texture(SmallTile(), 3);
  for (const auto& [column, row] : {std::pair{0, 0}, {17, 5}, {127, 127}, {64, 90}}) {
    const Eigen::Array3f color =
        texture.Sample(0.01F * (column + 0.5F), 0.01F * (row + 0.5F), 0.001F);
    EXPECT_TRUE(color.isApprox(Texel(texture, column, row), 1e-6F)) << column << " " << row;
  }
}

TEST(Texture, HalfwayBetweenTexelsIsTheirMean) {
  const Texture texture(SmallTile(), 3);
  for (int column = 10; column < 40; ++column) {
    const Eigen::Array3f color = texture.Sample(0.01F * (column + 1), 0.205F, 0);
    const Eigen::Array3f mean =
        0.5F * (Texel(texture, column, 20) + Texel(texture, column + 1, 20));
    EXPECT_LE((color - mean).abs().maxCoeff(), 2) << column;
  }
}

TEST(Texture, RepeatsOverThePlaneAndAcrossItsBorderWithoutSeam) {
  const Texture texture(SmallTile(), 4);
  RandomEngine engine = MakeRandomEngine(5, 0);
  for (int i = 0; i < 100; ++i) {
    const float u = static_cast<float>(UniformReal(engine));
    const float v = static_cast<float>(UniformReal(engine));
    const Eigen::Array3f here = texture.Sample(u, v, 0.02F);
    const Eigen::Array3f there = texture.Sample(u - 3 * 1.28F, v + 2 * 1.28F, 0.02F);
    EXPECT_LE((here - there).abs().maxCoeff(), 2);
  }
  const Eigen::Array3f border = texture.Sample(0, 0.305F, 0);
  const Eigen::Array3f mean = 0.5F * (Texel(texture, 127, 30) + Texel(texture, 0, 30));
  EXPECT_LE((border - mean).abs().maxCoeff(), 2);
}

TEST(Texture, WideFootprintGivesTheMeanColor) {
  const Texture texture(SmallTile(), 6);
  const cv::Scalar mean = cv::mean(texture.image());
  const Eigen::Array3f color = texture.Sample(0.3F, 0.9F, 100);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(color[c], mean[c], 5);
}

TEST(Texture, ColorChangesGraduallyWithTheFootprint) {
  const Texture texture(SmallTile(), 7);
  double total = 0;
  Eigen::Array3f before = texture.Sample(0.411F, 0.233F, 0.005F);
  for (float footprint = 0.005F; footprint < 2; footprint *= 1.01F) {
    const Eigen::Array3f color = texture.Sample(0.411F, 0.233F, footprint);
    EXPECT_LE((color - before).abs().maxCoeff(), 6) << footprint;
    total += (color - before).abs().sum();
    before = color;
  }
  EXPECT_GT(total, 10);
}

TEST(Texture, PatchesHaveManyCornersAndNoiseFew) {
  EXPECT_GT(CornerShare(Texture(SmallTile(TextureStyle::kPatches), 8)), 0.06);
  EXPECT_LT(CornerShare(Texture(SmallTile(TextureStyle::kNoise), 8)), 0.02);
}

TEST(Texture, PatchesHaveCornersAtEveryScale) {
  TextureOptions options = SmallTile();
  options.size_px = 512;
  const Texture texture(options, 9);
  cv::Mat gray;
  cv::cvtColor(texture.image(), gray, cv::COLOR_BGRA2GRAY);
  for (int level = 0; level < 4; ++level) {
    cv::Mat strength;
    cv::cornerMinEigenVal(gray, strength, 3);
    EXPECT_GT(cv::countNonZero(strength > 1e-3), 0.02 * strength.total()) << level;
    cv::resize(gray, gray, cv::Size(), 0.5, 0.5, cv::INTER_AREA);
  }
}

TEST(Texture, CheckerAlternatesEverySixteenTexels) {
  const Texture texture(SmallTile(TextureStyle::kChecker), 10);
  EXPECT_TRUE(Texel(texture, 3, 3).isApprox(Texel(texture, 15, 15)));
  EXPECT_TRUE(Texel(texture, 3, 3).isApprox(Texel(texture, 19, 19)));
  EXPECT_GT((Texel(texture, 3, 3) - Texel(texture, 19, 3)).abs().minCoeff(), 100);
}

TEST(Texture, WithoutContrastThereIsOneColor) {
  TextureOptions options = SmallTile();
  options.contrast = 0;
  const Texture texture(options, 11);
  cv::Scalar mean, deviation;
  cv::meanStdDev(texture.image(), mean, deviation);
  EXPECT_LT(deviation[0], 0.5);
  EXPECT_NEAR(mean[0], 127, 1);
}

TEST(Texture, SizeThatIsNoPowerOfTwoIsRefused) {
  TextureOptions options = SmallTile();
  options.size_px = 100;
  EXPECT_THROW(Texture(options, 1), std::logic_error);
}

TEST(Texture, StylesHaveNames) {
  EXPECT_EQ(EnumNames(TextureStyle{}).size(), 3U);
  EXPECT_EQ(EnumNames(TextureStyle{})[1].second, "checker");
}

}  // namespace
}  // namespace ofm
