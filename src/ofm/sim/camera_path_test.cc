#include "ofm/sim/camera_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ofm {
namespace {

const Viewpoint kViewpoint{{0, -0.8, 1.35}, {0, 2, 0.95}};

CameraPath MakePath(CameraPathKind kind) {
  CameraPathOptions options;
  options.kind = kind;
  return {options, kViewpoint};
}

Eigen::Vector3d Axis(const RigidTransform& world_from_camera, int axis) {
  return world_from_camera.RotationMatrix().col(axis);
}

class EveryPath : public testing::TestWithParam<CameraPathKind> {};

TEST_P(EveryPath, IsSmoothAtHandHeldSpeed) {
  const CameraPath path = MakePath(GetParam());
  const double step_s = 1.0 / 30;
  double speed = 0, turn_rate = 0, acceleration = 0;
  for (double t = 0; t < 30; t += step_s) {
    const RigidTransform a = path.WorldFromCamera(t);
    const RigidTransform b = path.WorldFromCamera(t + step_s);
    const RigidTransform c = path.WorldFromCamera(t + 2 * step_s);
    ASSERT_TRUE(a.IsFinite());
    const Eigen::Vector3d step = b.translation() - a.translation();
    const Eigen::Vector3d next_step = c.translation() - b.translation();
    speed = std::max(speed, step.norm() / step_s);
    turn_rate = std::max(turn_rate, (a.Inverse() * b).RotationAngle() / step_s);
    acceleration = std::max(acceleration, (next_step - step).norm() / (step_s * step_s));
  }
  EXPECT_LT(speed, 1.2);
  EXPECT_LT(turn_rate, 1.2);
  EXPECT_LT(acceleration, 3);
}

TEST_P(EveryPath, StaysInsideTheRoom) {
  const CameraPath path = MakePath(GetParam());
  for (double t = 0; t < 60; t += 0.1) {
    const Eigen::Vector3d eye = path.WorldFromCamera(t).translation();
    EXPECT_LT(std::abs(eye.x()), 2.8);
    EXPECT_LT(std::abs(eye.y()), 2.3);
    EXPECT_GT(eye.z(), 0.3);
    EXPECT_LT(eye.z(), 2.5);
  }
}

INSTANTIATE_TEST_SUITE_P(CameraPath, EveryPath,
                         testing::Values(CameraPathKind::kStatic, CameraPathKind::kXyz,
                                         CameraPathKind::kRpy, CameraPathKind::kHalfsphere,
                                         CameraPathKind::kTour));

TEST(LookAt, CameraLooksAtTheTargetWithItsXAxisLevel) {
  const RigidTransform world_from_camera = LookAt({1, 2, 3}, {-2, 0.5, 1});
  const Eigen::Vector3d target = world_from_camera.Inverse() * Eigen::Vector3d(-2, 0.5, 1);
  EXPECT_NEAR(target.head<2>().norm(), 0, 1e-12);
  EXPECT_GT(target.z(), 0);
  EXPECT_NEAR(Axis(world_from_camera, 0).z(), 0, 1e-12);
  EXPECT_LT(Axis(world_from_camera, 1).z(), 0) << "y is down";
  EXPECT_NEAR(world_from_camera.RotationMatrix().determinant(), 1, 1e-12);
}

TEST(LookAt, VerticalViewIsRefused) {
  EXPECT_THROW(LookAt({0, 0, 2}, {0, 0, 1}), std::logic_error);
}

TEST(CameraPath, StaticCameraStays) {
  const CameraPath path = MakePath(CameraPathKind::kStatic);
  EXPECT_EQ(path.WorldFromCamera(0).translation(), path.WorldFromCamera(7).translation());
  EXPECT_EQ(path.WorldFromCamera(0).translation(), kViewpoint.eye_in_world);
}

TEST(CameraPath, XyzKeepsItsDirectionAndUsesAllAxes) {
  const CameraPath path = MakePath(CameraPathKind::kXyz);
  const RigidTransform start = path.WorldFromCamera(0);
  Eigen::Array3d reach = Eigen::Array3d::Zero();
  for (double t = 0; t < 12; t += 0.05) {
    const RigidTransform change = start.Inverse() * path.WorldFromCamera(t);
    EXPECT_LT(change.RotationAngle(), 1e-6);
    reach = reach.max(change.translation().array().abs());
  }
  EXPECT_NEAR(reach.minCoeff(), 0.2, 0.01);
  EXPECT_NEAR(reach.maxCoeff(), 0.2, 0.01);
}

TEST(CameraPath, RpyTurnsNearlyInPlace) {
  const CameraPath path = MakePath(CameraPathKind::kRpy);
  const RigidTransform start = path.WorldFromCamera(0);
  double turn = 0;
  for (double t = 0; t < 12; t += 0.05) {
    const RigidTransform change = start.Inverse() * path.WorldFromCamera(t);
    EXPECT_LT(change.translation().norm(), 0.04);
    turn = std::max(turn, change.RotationAngle());
  }
  EXPECT_GT(turn, 15 * std::numbers::pi / 180);
}

TEST(CameraPath, HalfsphereKeepsItsDistanceFromTheTarget) {
  const CameraPath path = MakePath(CameraPathKind::kHalfsphere);
  const double radius = (kViewpoint.eye_in_world - kViewpoint.target_in_world).norm();
  double left = 0, right = 0;
  for (double t = 0; t < 12; t += 0.05) {
    const RigidTransform pose = path.WorldFromCamera(t);
    const Eigen::Vector3d target = pose.Inverse() * kViewpoint.target_in_world;
    EXPECT_NEAR(target.z(), radius, 1e-9);
    EXPECT_NEAR(target.head<2>().norm(), 0, 1e-9);
    left = std::min(left, pose.translation().x());
    right = std::max(right, pose.translation().x());
  }
  EXPECT_LT(left, -1);
  EXPECT_GT(right, 1);
}

TEST(CameraPath, TourTurnsOnceAboutAndEndsWhereItBegan) {
  const CameraPath path = MakePath(CameraPathKind::kTour);
  const double round_s = 4 * CameraPathOptions{}.period_s;
  const RigidTransform start = path.WorldFromCamera(0);
  EXPECT_LT((start.Inverse() * path.WorldFromCamera(round_s)).translation().norm(), 1e-9);
  EXPECT_LT(Axis(path.WorldFromCamera(round_s / 2), 2).dot(Axis(start, 2)), -0.9);
  EXPECT_GT((path.WorldFromCamera(round_s / 2).translation() - start.translation()).norm(), 1.9);
}

TEST(CameraPath, TourGoesTheWorldsWayLookingAheadAndCloses) {
  CameraPathOptions options;
  options.kind = CameraPathKind::kTour;
  options.tour_speed_mps = 0.5;
  Viewpoint viewpoint = kViewpoint;
  viewpoint.tour_in_world = {{0, 0}, {8, 0}, {8, 4}, {0, 4}};
  const CameraPath path(options, viewpoint);
  const RigidTransform pose = path.WorldFromCamera(8);
  EXPECT_LT((pose.translation() - Eigen::Vector3d(4, 0, 1.35)).norm(), 1e-6);
  EXPECT_GT(Axis(pose, 2).x(), 0.95);
  const RigidTransform round = path.WorldFromCamera(8 + 24 / 0.5);
  EXPECT_LT((round.translation() - pose.translation()).norm(), 1e-6);
}

TEST(CameraPath, HandTremblesAsMuchAsAsked) {
  CameraPathOptions options;
  options.kind = CameraPathKind::kStatic;
  options.jitter_m = 0.01;
  options.jitter_deg = 1;
  const CameraPath path(options, kViewpoint);
  const RigidTransform still = MakePath(CameraPathKind::kStatic).WorldFromCamera(0);
  double shift = 0, turn = 0;
  for (double t = 0; t < 20; t += 0.05) {
    const RigidTransform offset = still.Inverse() * path.WorldFromCamera(t);
    shift = std::max(shift, offset.translation().cwiseAbs().maxCoeff());
    turn = std::max(turn, offset.RotationAngle() * 180 / std::numbers::pi);
  }
  EXPECT_LE(shift, 0.01);
  EXPECT_GT(shift, 0.005);
  EXPECT_LE(turn, 1.8);
  EXPECT_GT(turn, 0.5);
}

}  // namespace
}  // namespace ofm
