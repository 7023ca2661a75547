#include "ofm/estimation/pnp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "ofm/estimation/test_world.h"

namespace ofm {
namespace {

using test::Depths;
using Frame = std::vector<PoseObservation>;

const PinholeCamera kCamera = *FindCameraPreset("tum-fr1");
const RigidTransform kTruth(ExpSo3(Eigen::Vector3d(-0.3, 2.2, 0.5)), Eigen::Vector3d(3, -2, 0.5));

struct Case {
  int count = 200;
  int wrong = 0;
  Depths depths = Depths::kAll;
};

Frame MakeMatches(const Case& c, int seed) {
  RandomEngine engine = MakeRandomEngine(3, seed);
  Frame frame = test::MakeFrame(kCamera, kTruth, c.count, c.depths, {}, engine);
  test::Spoil(kCamera, c.wrong, frame, engine);
  return frame;
}

std::optional<PoseEstimate> Estimate(const Frame& matches, int seed = 0,
                                     const PnpOptions& options = {}) {
  RandomEngine engine = MakeRandomEngine(4, seed);
  return EstimatePoseRansac(kCamera, matches, options, engine);
}

void ExpectFound(const Case& c, int trials) {
  for (int seed = 0; seed < trials; ++seed) {
    const auto estimate = Estimate(MakeMatches(c, seed), seed);
    ASSERT_TRUE(estimate) << seed;
    EXPECT_TRUE(estimate->converged);
    EXPECT_LT(test::Difference(estimate->camera_from_world, kTruth).norm(), 0.02) << seed;
    int kept_wrong = 0, kept_right = 0;
    for (int i = 0; i < c.count; ++i) {
      (i < c.wrong ? kept_wrong : kept_right) += estimate->inlier[i];
    }
    EXPECT_LE(kept_wrong, 3) << seed;
    EXPECT_GE(kept_right, 0.85 * (c.count - c.wrong)) << seed;
    EXPECT_EQ(estimate->inlier_count, kept_wrong + kept_right);
  }
}

TEST(Pnp, SevenOfTenMatchesWithDepthMayBeWrong) {
  ExpectFound({.count = 200, .wrong = 140, .depths = Depths::kAll}, 20);
}

TEST(Pnp, SevenOfTenMatchesWithoutDepthMayBeWrong) {
  ExpectFound({.count = 200, .wrong = 140, .depths = Depths::kNone}, 10);
}

TEST(Pnp, MatchesWithAndWithoutDepthWorkTogether) {
  ExpectFound({.count = 100, .wrong = 50, .depths = Depths::kEverySecond}, 10);
}

TEST(Pnp, WithFewDepthsThePixelsDecide) {
  Frame matches = MakeMatches({.count = 60, .wrong = 20, .depths = Depths::kAll}, 1);
  for (int i = 10; i < 60; ++i) matches[i].seen.depth_m = 0;  // depth in ten wrong ones alone
  const auto estimate = Estimate(matches);
  ASSERT_TRUE(estimate);
  EXPECT_LT(test::Difference(estimate->camera_from_world, kTruth).norm(), 0.02);
}

TEST(Pnp, TooFewMatchesGiveNoPose) {
  EXPECT_FALSE(Estimate({}));
  const Frame matches = MakeMatches({.count = 14}, 1);
  EXPECT_FALSE(Estimate(matches));
  EXPECT_TRUE(Estimate(matches, 0, {.min_inliers = 12}));
}

TEST(Pnp, TooFewRightMatchesGiveNoPose) {
  EXPECT_FALSE(Estimate(MakeMatches({.count = 100, .wrong = 88}, 1)));
  EXPECT_FALSE(Estimate(MakeMatches({.count = 100, .wrong = 100}, 2)));
  EXPECT_FALSE(Estimate(MakeMatches({.count = 100, .wrong = 100, .depths = Depths::kNone}, 3)));
}

TEST(Pnp, PointsInOneLineGiveNoPose) {
  for (const Depths depths : {Depths::kAll, Depths::kNone}) {
    Frame matches = MakeMatches({.count = 30}, 1);
    RandomEngine engine = MakeRandomEngine(5, 0);
    for (int i = 0; i < 30; ++i) {
      const Eigen::Vector3d point =
          Eigen::Vector3d(-0.5, 0.1, 2) + 0.03 * i * Eigen::Vector3d(1, 0.3, 0.5);
      matches[i].point_in_world = kTruth.Inverse() * point;
      matches[i].seen = test::Observe(kCamera, point, {.factor = 0}, engine);
      if (depths == Depths::kNone) matches[i].seen.depth_m = 0;
    }
    EXPECT_FALSE(Estimate(matches));
  }
}

TEST(Pnp, OnePointManyTimesGivesNoPose) {
  const Frame matches(30, MakeMatches({.count = 1}, 1)[0]);
  EXPECT_FALSE(Estimate(matches));
}

TEST(Pnp, TheSameEngineGivesTheSameNumbers) {
  const Frame matches = MakeMatches({.count = 100, .wrong = 60}, 1);
  const auto a = Estimate(matches, 7), b = Estimate(matches, 7);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->camera_from_world.translation(), b->camera_from_world.translation());
  EXPECT_EQ(a->camera_from_world.rotation().coeffs(), b->camera_from_world.rotation().coeffs());
  EXPECT_EQ(a->inlier, b->inlier);
}

TEST(Pnp, GoodMatchesNeedFewDraws) {
  RandomEngine few = MakeRandomEngine(6, 0), many = few, start = few;
  ASSERT_TRUE(EstimatePoseRansac(kCamera, MakeMatches({}, 1), {}, few));
  ASSERT_FALSE(EstimatePoseRansac(kCamera, MakeMatches({.wrong = 200}, 1), {}, many));
  const auto draws_up_to = [&](const RandomEngine& end) {
    RandomEngine engine = start;
    int draws = 0;
    for (; engine != end && draws < 2000; ++draws) engine();
    return draws;
  };
  EXPECT_LT(draws_up_to(few), 60);
  EXPECT_GE(draws_up_to(many), 900);  // three for each of 300 samples
}

TEST(Pnp, NumbersThatAreNoneAreTheProgrammersFault) {
  Frame matches = MakeMatches({.count = 20}, 1);
  matches[3].seen.ideal_px.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Estimate(matches), std::logic_error);
}

}  // namespace
}  // namespace ofm
