#include "ofm/sim/material.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "ofm/sim/print.h"

namespace ofm {
namespace {

cv::Scalar Deviation(const Texture& texture) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(texture.image(), mean, deviation);
  return deviation;
}

TEST(Material, EachHasItsTexture) {
  for (int k = 0; k <= static_cast<int>(Material::kHair); ++k) {
    const Texture texture = MakeMaterial(static_cast<Material>(k), {120, 130, 140}, 3);
    EXPECT_GT(Deviation(texture)[1], 1) << k;
    EXPECT_LT(Deviation(texture)[1], 90) << k;
  }
}

TEST(Material, SameSeedGivesTheSameTexture) {
  const auto make = [](std::uint64_t seed) {
    return MakeMaterial(Material::kSpines, cv::Scalar::all(0), seed).image().clone();
  };
  EXPECT_EQ(cv::norm(make(1), make(1), cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(make(1), make(2), cv::NORM_INF), 0);
}

TEST(Material, HasItsColor) {
  const cv::Scalar mean = cv::mean(MakeMaterial(Material::kPlaster, {190, 120, 60}, 1).image());
  EXPECT_NEAR(mean[0], 190, 8);
  EXPECT_NEAR(mean[2], 60, 8);
}

TEST(Print, EachIsAnImageOfManyLevels) {
  for (int k = 0; k <= static_cast<int>(Print::kWindow); ++k) {
    EXPECT_GT(Deviation(MakePrint(static_cast<Print>(k), 0.6, 0.4, 7))[1], 8) << k;
  }
}

TEST(Print, ItsMiddleIsAtTheOriginAndItStandsUpright) {
  // A screen's bar is at its lower edge and dark; the window's sky is at its upper edge.
  const Texture window = MakePrint(Print::kWindow, 1.2, 0.9, 1);
  const Eigen::Array3f frame_left = window.Sample(-0.59F, 0, 0);
  const Eigen::Array3f frame_right = window.Sample(0.59F, 0, 0);
  const Eigen::Array3f frame_above = window.Sample(0.3F, 0.44F, 0);
  for (const Eigen::Array3f& color : {frame_left, frame_right, frame_above}) {
    EXPECT_NEAR(color[1], 228, 3);
  }
  const Eigen::Array3f sky = window.Sample(0.3F, 0.3F, 0);
  EXPECT_GT(sky[0], sky[2]) << "blue";
}

}  // namespace
}  // namespace ofm
