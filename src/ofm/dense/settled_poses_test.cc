#include "ofm/dense/settled_poses.h"

#include <gtest/gtest.h>

#include "ofm/dense/test_scene.h"

namespace ofm {
namespace {

using test::At;

constexpr double kTolerance_m = .01;
const KeyframeId kFirst(0), kSecond(1);

double PlaceOf(const KeyframePoseMap& poses, KeyframeId id) {
  return poses.at(id).translation().x();
}

TEST(SettledPoses, ANewOneIsHeldBackUntilItRests) {
  SettledPoses poses({}, kTolerance_m);
  EXPECT_TRUE(poses.Update({{kFirst, At(1, 0, 0)}}).empty());
  EXPECT_TRUE(poses.Update({{kFirst, At(1.5, 0, 0)}}).empty());
  EXPECT_EQ(PlaceOf(poses.Update({{kFirst, At(1.505, 0, 0)}}), kFirst), 1.505);
}

TEST(SettledPoses, OneThatMovesStaysWhereItWasUntilItRestsAgain) {
  SettledPoses poses({}, kTolerance_m);
  for (int i = 0; i < 2; ++i) poses.Update({{kFirst, At(1, 0, 0)}});
  EXPECT_EQ(PlaceOf(poses.Update({{kFirst, At(2, 0, 0)}}), kFirst), 1);
  EXPECT_EQ(PlaceOf(poses.Update({{kFirst, At(2, 0, 0)}}), kFirst), 2);
}

TEST(SettledPoses, NewOnesComeInOrder) {
  SettledPoses poses({}, kTolerance_m);
  poses.Update({{kFirst, At(1, 0, 0)}, {kSecond, At(2, 0, 0)}});
  EXPECT_TRUE(poses.Update({{kFirst, At(1.5, 0, 0)}, {kSecond, At(2, 0, 0)}}).empty());
  EXPECT_EQ(poses.Update({{kFirst, At(1.5, 0, 0)}, {kSecond, At(2, 0, 0)}}).size(), 2U);
  EXPECT_EQ(poses.Update({{kFirst, At(1.6, 0, 0)}, {kSecond, At(2, 0, 0)}}).size(), 2U);
}

TEST(SettledPoses, ATurnCountsByWhatItMoves) {
  SettledPoses poses({}, kTolerance_m);
  const RigidTransform turned(Eigen::Quaterniond(Eigen::AngleAxisd(.01, Eigen::Vector3d::UnitY())),
                              Eigen::Vector3d::Zero());
  for (int i = 0; i < 2; ++i) poses.Update({{kFirst, At(0, 0, 0)}});
  EXPECT_EQ(poses.Update({{kFirst, turned}}).at(kFirst).RotationAngle(), 0);
}

TEST(SettledPoses, OnesThatAreGoneAreForgotten) {
  SettledPoses poses({}, kTolerance_m);
  for (int i = 0; i < 2; ++i) poses.Update({{kFirst, At(1, 0, 0)}, {kSecond, At(2, 0, 0)}});
  const KeyframePoseMap& left = poses.Update({{kSecond, At(2, 0, 0)}});
  EXPECT_EQ(left.size(), 1U);
  EXPECT_TRUE(left.contains(kSecond));
}

}  // namespace
}  // namespace ofm
