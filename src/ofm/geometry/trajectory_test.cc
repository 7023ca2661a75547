#include "ofm/geometry/trajectory.h"

#include <gtest/gtest.h>

namespace ofm {
namespace {

/// Three poses at 100, 200 and 600 ns: a metre along x and a quarter turn about z between two.
Trajectory MakeTrajectory() {
  Trajectory trajectory;
  for (const int i : {0, 1, 2}) {
    const std::int64_t stamp_ns = i == 2 ? 600 : 100 * (i + 1);
    trajectory.push_back(
        {stamp_ns, {ExpSo3({0, 0, i * M_PI / 2}), Eigen::Vector3d(static_cast<double>(i), 0, 0)}});
  }
  return trajectory;
}

TEST(InterpolatePose, BetweenTwoPosesItIsBetweenThem) {
  const auto pose = InterpolatePose(MakeTrajectory(), 125);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->translation().x(), 0.25, 1e-12);
  EXPECT_NEAR(pose->RotationAngle(), 0.25 * M_PI / 2, 1e-12);
  const auto second = InterpolatePose(MakeTrajectory(), 500);
  ASSERT_TRUE(second);
  EXPECT_NEAR(second->translation().x(), 1.75, 1e-12);
}

TEST(InterpolatePose, AtAPoseItIsThatPose) {
  for (const StampedPose& known : MakeTrajectory()) {
    const auto pose = InterpolatePose(MakeTrajectory(), known.stamp_ns, 1);
    ASSERT_TRUE(pose) << known.stamp_ns;
    EXPECT_EQ(pose->translation(), known.world_from_camera.translation());
    EXPECT_EQ(pose->rotation().coeffs(), known.world_from_camera.rotation().coeffs());
  }
}

TEST(InterpolatePose, OutsideOfTheTrajectoryThereIsNone) {
  EXPECT_FALSE(InterpolatePose(MakeTrajectory(), 99));
  EXPECT_FALSE(InterpolatePose(MakeTrajectory(), 601));
  EXPECT_FALSE(InterpolatePose({}, 100));
}

TEST(InterpolatePose, AcrossAGapThereIsNone) {
  EXPECT_TRUE(InterpolatePose(MakeTrajectory(), 300, 400));
  EXPECT_FALSE(InterpolatePose(MakeTrajectory(), 300, 399));
  EXPECT_TRUE(InterpolatePose(MakeTrajectory(), 150, 399));
}

}  // namespace
}  // namespace ofm
