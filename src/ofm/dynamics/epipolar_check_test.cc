#include "ofm/dynamics/epipolar_check.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "ofm/dynamics/test_scene.h"

namespace ofm {
namespace {

PointPairs IdealPairs(const test::Scene& scene, const FlowResult& flow) {
  PointPairs pairs;
  for (std::size_t i = 0; i < flow.size(); ++i) {
    if (!flow.IsTracked(i)) continue;
    pairs.Add(scene.camera.Undistort(flow.previous[i].cast<double>()),
              scene.camera.Undistort(flow.current[i].cast<double>()));
  }
  return pairs;
}

/// F of two images side by side: the epipolar line of (x, y) is the row y.
Eigen::Matrix3d SideBySide() {
  Eigen::Matrix3d fundamental;
  fundamental << 0, 0, 0, 0, 0, -1, 0, 1, 0;
  return fundamental;
}

TEST(EpipolarDistance, IsThatToTheRowForImagesSideBySide) {
  EXPECT_DOUBLE_EQ(EpipolarDistance(SideBySide(), {10, 50}, {300, 50}), 0);
  EXPECT_DOUBLE_EQ(EpipolarDistance(SideBySide(), {10, 50}, {300, 57}), 7);
  EXPECT_DOUBLE_EQ(EpipolarDistance(SideBySide() * -40, {10, 50}, {0, 44}), 6);
}

TEST(EpipolarDistance, IsZeroWhereThereIsNoLine) {
  EXPECT_EQ(EpipolarDistance(Eigen::Matrix3d::Zero(), {10, 50}, {300, 57}), 0);
}

/// Believed where half of the pairs agree: these scenes have many movers.
const EpipolarOptions kHalf{.min_inlier_share = 0.5};

TEST(FitFundamental, StaticPointsAreWithinHalfAPixelOfTheirLines) {
  const test::Scene scene;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const PointPairs pairs = IdealPairs(scene, scene.Flow({}, seed));
    const auto fit = FitFundamental(pairs, {});
    ASSERT_TRUE(fit);
    EXPECT_GT(fit->inliers, pairs.size() * 98 / 100);
    EXPECT_NEAR(fit->second_from_first.determinant(), 0, 1e-9);
    double largest = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      largest = std::max(largest,
                         EpipolarDistance(fit->second_from_first, pairs.first[i], pairs.second[i]));
    }
    EXPECT_LT(largest, 0.6);
  }
}

TEST(FitFundamental, IsNotLedAstrayByAThirdOfMovingPoints) {
  const test::Scene scene{.mover_count = 200};
  const PointPairs pairs = IdealPairs(scene, scene.Flow({.mover_shift_m = {0, 0.08, 0}}, 1));
  const auto fit = FitFundamental(pairs, kHalf);
  ASSERT_TRUE(fit);
  for (std::size_t i = 0; i < 300; ++i) {
    EXPECT_LT(EpipolarDistance(fit->second_from_first, pairs.first[i], pairs.second[i]), 2);
  }
}

/// OpenCV's RANSAC must not depend on what was drawn before, nor on the number of threads.
TEST(FitFundamental, SamePairsGiveTheSameMatrixToTheBit) {
  const test::Scene scene{.mover_count = 200};
  const PointPairs pairs = IdealPairs(scene, scene.Flow({.mover_shift_m = {0, 0.08, 0}}, 2));
  const auto first = FitFundamental(pairs, kHalf);
  ASSERT_TRUE(first);
  const int threads = cv::getNumThreads();
  for (int round = 0; round < 3; ++round) {
    cv::theRNG().next();
    FitFundamental(IdealPairs(scene, scene.Flow({}, round)), {});
    cv::setNumThreads(1 + round % 2);
    const auto again = FitFundamental(pairs, kHalf);
    ASSERT_TRUE(again);
    EXPECT_EQ(first->second_from_first, again->second_from_first);
    EXPECT_EQ(first->inliers, again->inliers);
  }
  cv::setNumThreads(threads);
}

TEST(FitFundamental, TooFewPairsGiveNoMatrix) {
  const test::Scene scene{.static_count = 29};
  const PointPairs pairs = IdealPairs(scene, scene.Flow({.camera_turn_rad = {0, 0, 0}}, 3));
  EXPECT_FALSE(FitFundamental(pairs, {}));
  EXPECT_FALSE(FitFundamental({}, {}));
  EXPECT_TRUE(FitFundamental(pairs, {.min_points = 15}));
}

TEST(FitFundamental, PairsThatDisagreeGiveNoMatrix) {
  const test::Scene scene;
  const PointPairs pairs = IdealPairs(scene, scene.Flow({.noise_px = 40}, 4));
  EXPECT_FALSE(FitFundamental(pairs, {}));
  EXPECT_TRUE(FitFundamental(pairs, {.min_inlier_share = 0}));
}

TEST(FitFundamental, PairsInOnePlaceAreSurvived) {
  PointPairs pairs;
  for (int i = 0; i < 100; ++i) pairs.Add({100, 100}, {100, 100});
  const auto fit = FitFundamental(pairs, {});
  EXPECT_TRUE(!fit || fit->second_from_first.allFinite());
}

}  // namespace
}  // namespace ofm
