#include "ofm/perception/displacement_field.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "ofm/base/random.h"

namespace ofm {
namespace {

/// Points on a grid of 150 × 120 px and where `moved` takes them.
template <class Moved>
PointMotion MakeMotion(Moved&& moved) {
  PointMotion motion;
  for (float y = 40; y < 160; y += 15) {
    for (float x = 50; x < 200; x += 15) {
      motion.from.emplace_back(x, y);
      motion.to.push_back(moved(motion.from.back()));
    }
  }
  return motion;
}

Eigen::Vector2f SourceAt(const DisplacementField& field, const Eigen::Vector2f& point) {
  const cv::Rect pixel(cvRound(point.x()), cvRound(point.y()), 1, 1);
  const cv::Vec2f source = field.SourceOf(pixel, 1).at<cv::Vec2f>(0, 0);
  return {source[0], source[1]};
}

TEST(DisplacementField, FindsAShift) {
  const Eigen::Vector2f shift(12.5F, -4);
  const auto field = DisplacementField::Fit(
      MakeMotion([&](const Eigen::Vector2f& p) { return Eigen::Vector2f(p + shift); }), {});
  ASSERT_TRUE(field);
  EXPECT_LT((field->mean_shift() - shift).norm(), 1e-3F);
  EXPECT_LT((SourceAt(*field, {100, 90}) - (Eigen::Vector2f(100, 90) - shift)).norm(), 1e-2F);
}

TEST(DisplacementField, FindsTurnAndScaleAndUndoesThem) {
  const Eigen::Rotation2Df turn(0.15F);
  const Eigen::Vector2f centre(120, 100), shift(5, 8);
  const auto moved = [&](const Eigen::Vector2f& p) {
    return Eigen::Vector2f(centre + shift + 1.08F * (turn * (p - centre)));
  };
  const auto field = DisplacementField::Fit(MakeMotion(moved), {});
  ASSERT_TRUE(field);
  EXPECT_LT((field->Forward({70, 60}) - moved({70, 60})).norm(), 0.05F);
  const cv::Rect region(60, 50, 120, 100);
  const cv::Mat source = field->SourceOf(region, 1);
  for (int y = 0; y < region.height; y += 9) {
    for (int x = 0; x < region.width; x += 7) {
      const cv::Vec2f from = source.at<cv::Vec2f>(y, x);
      const Eigen::Vector2f back = moved({from[0], from[1]});
      EXPECT_LT((back - Eigen::Vector2f(region.x + x, region.y + y)).norm(), 0.1F);
    }
  }
}

TEST(DisplacementField, IgnoresAThirdOfWrongPoints) {
  const Eigen::Vector2f shift(-9, 3);
  RandomEngine engine = MakeRandomEngine(1, 0);
  std::size_t wrong = 0;
  const PointMotion motion = MakeMotion([&](const Eigen::Vector2f& p) {
    if (UniformReal(engine) > 0.33) return Eigen::Vector2f(p + shift);
    ++wrong;
    return Eigen::Vector2f(p + Eigen::Vector2f(10 + 30 * static_cast<float>(UniformReal(engine)),
                                               -40 * static_cast<float>(UniformReal(engine))));
  });
  const auto field = DisplacementField::Fit(motion, {});
  ASSERT_TRUE(field);
  EXPECT_EQ(field->inliers().size(), motion.from.size() - wrong);
  EXPECT_LT((field->mean_shift() - shift).norm(), 0.5F);
}

TEST(DisplacementField, AnArmThatGoesItsOwnWayIsFollowed) {
  const auto moved = [](const Eigen::Vector2f& p) {
    return Eigen::Vector2f(p + Eigen::Vector2f(10, p.x() > 160 ? 7 : 0));
  };
  const auto field = DisplacementField::Fit(MakeMotion(moved), {});
  ASSERT_TRUE(field);
  EXPECT_NEAR(SourceAt(*field, {195, 107}).y(), 100, 2);
  EXPECT_NEAR(SourceAt(*field, {80, 100}).y(), 100, 1);
}

TEST(DisplacementField, WorksInReducedPixels) {
  const Eigen::Vector2f shift(6, 2);
  const auto field = DisplacementField::Fit(
      MakeMotion([&](const Eigen::Vector2f& p) { return Eigen::Vector2f(p + shift); }), {});
  ASSERT_TRUE(field);
  // The middle of the reduced pixel (40, 30) is at (80.5, 60.5).
  const cv::Vec2f source = field->SourceOf({40, 30, 5, 5}, 2).at<cv::Vec2f>(0, 0);
  EXPECT_NEAR(source[0], 74.5, 0.01);
  EXPECT_NEAR(source[1], 58.5, 0.01);
}

TEST(DisplacementField, FewOrQuarrellingPointsGiveNothing) {
  EXPECT_FALSE(DisplacementField::Fit({{{1, 1}, {9, 9}}, {{2, 1}, {10, 9}}}, {}));
  RandomEngine engine = MakeRandomEngine(2, 0);
  const PointMotion chaos = MakeMotion([&](const Eigen::Vector2f&) {
    return Eigen::Vector2f(400 * static_cast<float>(UniformReal(engine)),
                           400 * static_cast<float>(UniformReal(engine)));
  });
  EXPECT_FALSE(DisplacementField::Fit(chaos, {}));
  EXPECT_FALSE(DisplacementField::Fit({}, {}));
}

TEST(DisplacementField, PointsAllInOnePlaceGiveAShift) {
  PointMotion motion;
  for (int i = 0; i < 6; ++i) {
    motion.from.emplace_back(50, 50);
    motion.to.emplace_back(55, 48);
  }
  const auto field = DisplacementField::Fit(motion, {});
  ASSERT_TRUE(field);
  EXPECT_LT((field->Forward({0, 0}) - Eigen::Vector2f(5, -2)).norm(), 1e-3F);
}

}  // namespace
}  // namespace ofm
