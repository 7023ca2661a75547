#include "ofm/sim/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ofm {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Vector3d Forward(const RigidTransform& world_from_body) {
  return world_from_body.rotation() * Eigen::Vector3d::UnitX();
}

TEST(Motion, StaticBodyStays) {
  const RigidTransform place(ExpSo3({0, 0, 0.3}), {1, 2, 3});
  const Motion motion = StaticMotion{place};
  EXPECT_FALSE(IsMoving(motion));
  for (const double t : {0.0, 1.5, 1e6}) {
    EXPECT_EQ(WorldFromBody(motion, t).translation(), place.translation());
    EXPECT_EQ(WorldFromBody(motion, t).rotation().coeffs(), place.rotation().coeffs());
  }
}

TEST(Motion, SweepGoesFromOneEndToTheOther) {
  SweepMotion sweep{{1, 2, 0.5}, {0.7, 0, 0}, 4, 0};
  EXPECT_TRUE(IsMoving(sweep));
  EXPECT_NEAR((WorldFromBody(sweep, 0).translation() - Eigen::Vector3d(1, 2, 0.5)).norm(), 0,
              1e-12);
  EXPECT_NEAR(WorldFromBody(sweep, 1).translation().x(), 1.7, 1e-12);
  EXPECT_NEAR(WorldFromBody(sweep, 3).translation().x(), 0.3, 1e-12);
  sweep.phase_rad = kPi / 2;
  EXPECT_NEAR(WorldFromBody(sweep, 0).translation().x(), 1.7, 1e-12);
}

TEST(Motion, SweepingBodyLooksWhereItGoes) {
  const SweepMotion sweep{{0, 0, 0}, {0.3, 0.4, 0}, 4, 0};
  EXPECT_GT(Forward(WorldFromBody(sweep, 0)).dot(Eigen::Vector3d(0.6, 0.8, 0)), 0.999);
  EXPECT_LT(Forward(WorldFromBody(sweep, 2)).dot(Eigen::Vector3d(0.6, 0.8, 0)), -0.999);
}

TEST(Motion, SweepIsSmooth) {
  const SweepMotion sweep{{0, 0, 0}, {0.8, 0, 0}, 4, 0.3};
  const double step_s = 1e-3;
  const double top_speed = 0.8 * 2 * kPi / 4;
  for (double t = 0; t < 8; t += step_s) {
    const RigidTransform change =
        WorldFromBody(sweep, t).Inverse() * WorldFromBody(sweep, t + step_s);
    EXPECT_LE(change.translation().norm(), 1.001 * top_speed * step_s);
    EXPECT_LE(change.RotationAngle(), 15 * step_s + 1e-7);
  }
}

TEST(Motion, WaypointsAreReachedInTimeAndJoinedStraight) {
  const WaypointMotion way{{{1, {0, 0, 0}, 0}, {3, {2, 0, 0}, 0}, {4, {2, 1, 0}, kPi / 2}}};
  EXPECT_NEAR((WorldFromBody(way, 2).translation() - Eigen::Vector3d(1, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((WorldFromBody(way, 3).translation() - Eigen::Vector3d(2, 0, 0)).norm(), 0, 1e-12);
  const RigidTransform half = WorldFromBody(way, 3.5);
  EXPECT_NEAR((half.translation() - Eigen::Vector3d(2, 0.5, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR(Forward(half).x(), std::cos(kPi / 4), 1e-9);
}

TEST(Motion, BodyRestsBeforeTheFirstAndAfterTheLastWaypoint) {
  const WaypointMotion way{{{1, {5, 0, 0}, 0}, {3, {2, 0, 0}, 1}}};
  EXPECT_EQ(WorldFromBody(way, -10).translation().x(), 5);
  EXPECT_EQ(WorldFromBody(way, 1).translation().x(), 5);
  EXPECT_EQ(WorldFromBody(way, 99).translation().x(), 2);
  EXPECT_NEAR(WorldFromBody(way, 99).RotationAngle(), 1, 1e-9);
}

TEST(Motion, WayWithoutPointsIsRefused) {
  EXPECT_THROW(WorldFromBody(WaypointMotion{}, 0), std::logic_error);
}

TEST(Motion, ScriptSaysWhereItsBodyIs) {
  const Motion motion = ScriptedMotion{[](double time_s) {
    return RigidTransform(Eigen::Quaterniond::Identity(), Eigen::Vector3d(time_s, 0, 0));
  }};
  EXPECT_TRUE(IsMoving(motion));
  EXPECT_EQ(WorldFromBody(motion, 2.5).translation().x(), 2.5);
}

}  // namespace
}  // namespace ofm
