#include "ofm/sim/human_script.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ofm {
namespace {

using Eigen::Vector2d;

constexpr double kPi = std::numbers::pi;

/// Walks around a corner, sits down, rests and stands up.
HumanScript Busy() {
  HumanScript script({0, 0}, 0);
  script.Walk({{2, 0}, {2, 2}});
  script.SitDown({{2, 3}, -0.5 * kPi});
  script.Wait(2);
  script.StandUp();
  return script;
}

TEST(HumanScript, StandsBeforeAndAfterWhatItDoes) {
  const HumanScript script = Busy();
  EXPECT_EQ(script.At(-1).position, Vector2d(0, 0));
  const HumanState end = script.At(script.end_s() + 5);
  EXPECT_LT((end.position - script.end_position()).norm(), 1e-9);
  EXPECT_EQ(end.gait, 0);
  EXPECT_EQ(end.sit, 0);
}

TEST(HumanScript, NothingJumps) {
  constexpr double kStep_s = 1.0 / 60;
  const HumanScript script = Busy();
  for (double t = 0; t < script.end_s(); t += kStep_s) {
    const HumanState a = script.At(t), b = script.At(t + kStep_s);
    EXPECT_LT((a.position - b.position).norm(), 1.3 * kStep_s) << t;
    EXPECT_LT(std::abs(std::remainder(a.yaw_rad - b.yaw_rad, 2 * kPi)), 0.15) << t;
    EXPECT_LT(std::abs(a.sit - b.sit), 0.03) << t;
    EXPECT_LT(std::abs(a.gait - b.gait), 0.08) << t;
  }
}

TEST(HumanScript, LooksWhereItWalks) {
  const HumanScript script = Busy();
  const HumanState early = script.At(1.2);
  EXPECT_EQ(early.gait, 1);
  EXPECT_NEAR(early.yaw_rad, 0, 0.05);
  EXPECT_GT(early.position.x(), 0.5);
  EXPECT_NEAR(early.position.y(), 0, 1e-6);
}

TEST(HumanScript, SitsOnTheSeatAndLooksItsWay) {
  const HumanScript script = Busy();
  const HumanState seated = script.At(script.end_s() - 2.5);
  EXPECT_EQ(seated.sit, 1);
  EXPECT_LT((seated.position - Vector2d(2, 3)).norm(), 1e-9);
  EXPECT_NEAR(std::remainder(seated.yaw_rad + 0.5 * kPi, 2 * kPi), 0, 1e-9);
}

TEST(HumanScript, OneWhoSitsAlreadyStays) {
  const HumanScript script(Seat{{1, 2}, 0.3});
  for (const double t : {-1.0, 0.0, 100.0}) {
    EXPECT_EQ(script.At(t).sit, 1);
    EXPECT_EQ(script.At(t).position, Vector2d(1, 2));
  }
}

TEST(HumanScript, WalkingNowhereTakesNoTime) {
  HumanScript script({1, 1}, 0);
  script.Walk({{1, 1}});
  EXPECT_EQ(script.end_s(), 0);
}

TEST(FindJoints, LegsSwingAgainstOneAnotherAndArmsAgainstThem) {
  HumanState state;
  state.gait = 1;
  state.stride_rad = 0.5 * kPi;
  const JointAngles joints = FindJoints(state, 0, 0, 0);
  EXPECT_GT(joints.hip[0], 0.3);
  EXPECT_LT(joints.hip[1], -0.3);
  EXPECT_LT(joints.shoulder[0], joints.shoulder[1]);
}

TEST(FindJoints, WhoSitsIsLowWithBentKnees) {
  HumanState state;
  const double standing = FindJoints(state, 0, 0, 0).pelvis_m;
  state.sit = 1;
  const JointAngles joints = FindJoints(state, 0, 0, 0);
  EXPECT_LT(joints.pelvis_m, standing - 0.3);
  EXPECT_NEAR(joints.knee[0], 0.5 * kPi, 0.2);
}

TEST(FindJoints, WhoCarriesHoldsBothArmsAlike) {
  HumanState state;
  state.gait = 1;
  state.stride_rad = 1;
  const JointAngles joints = FindJoints(state, 2, 1, 1);
  EXPECT_EQ(joints.shoulder[0], joints.shoulder[1]);
  EXPECT_EQ(joints.elbow[0], joints.elbow[1]);
}

}  // namespace
}  // namespace ofm
