#include "ofm/sim/scene.h"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "ofm/sim/test_scene.h"

namespace ofm {
namespace {

TEST(Scene, MoversAreNumberedFirstThenNamedThingsAndTheRestIsBackground) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.2);
  const Scene scene({MakeTestWall(), MakeTestBody("chair", StaticMotion{}, Shape::kBox, half),
                     MakeTestBody("person", SweepMotion{}, Shape::kBox, half),
                     MakeTestBody("box", SweepMotion{}, Shape::kBox, half)},
                    {});
  EXPECT_EQ(scene.mover_count(), 2U);
  EXPECT_EQ(scene.class_names(), (std::vector<std::string>{"", "person", "box", "chair"}));
  EXPECT_EQ(scene.bodies()[0].id, InstanceId(0));
  EXPECT_EQ(scene.bodies()[1].id, InstanceId(3));
  EXPECT_EQ(scene.bodies()[2].id, InstanceId(1));
  EXPECT_EQ(scene.bodies()[3].id, InstanceId(2));
}

TEST(Scene, PartWithoutTextureIsRefused) {
  Body body = MakeTestWall();
  body.parts[0].texture = nullptr;
  EXPECT_THROW(Scene({body}, {}), std::logic_error);
}

TEST(Scene, MoreInstancesThanAByteHoldsAreRefused) {
  const Body ball = MakeTestBody("sports ball", StaticMotion{}, Shape::kEllipsoid, {1, 1, 1});
  EXPECT_NO_THROW(Scene(std::vector<Body>(255, ball), {}));
  EXPECT_THROW(Scene(std::vector<Body>(256, ball), {}), std::logic_error);
}

TEST(WorldFromPart, PartGoesWithItsBody) {
  Body body = MakeTestBody("box", SweepMotion{{0, 0, 0}, {1, 0, 0}, 4, 0}, Shape::kBox, {1, 1, 1});
  body.parts[0].body_from_part = Shift(0, 0, 2);
  const Eigen::Vector3d centre = WorldFromPart(body, body.parts[0], 0.5).translation();
  EXPECT_NEAR(centre.x(), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(centre.z(), 2, 1e-9);
}

TEST(WorldFromPart, LimbSwingsAboutItsPivot) {
  Body body = MakeTestBody("person", StaticMotion{}, Shape::kBox, {0.1, 0.1, 0.4});
  Part& leg = body.parts[0];
  leg.body_from_part = Shift(0, 0, 0.4);
  leg.swing = {{0, 0, 0.8}, {0, 1, 0}, 0.5, 1, 0};
  const Eigen::Vector3d rest = WorldFromPart(body, leg, 0).translation();
  EXPECT_NEAR((rest - Eigen::Vector3d(0, 0, 0.4)).norm(), 0, 1e-12);
  const RigidTransform forward = WorldFromPart(body, leg, 0.25);
  EXPECT_NEAR(forward.RotationAngle(), 0.5, 1e-9);
  EXPECT_NEAR((forward * Eigen::Vector3d(0, 0, 0.4) - Eigen::Vector3d(0, 0, 0.8)).norm(), 0, 1e-12);
  EXPECT_NEAR((forward * Eigen::Vector3d(0, 0, -0.4)).x(), -0.8 * std::sin(0.5), 1e-9);
}

TEST(WorldFromParts, ScriptPlacesThePartsOnTheBody) {
  Body body = MakeTestBody("person", StaticMotion{Shift(1, 0, 0)}, Shape::kBox, {1, 1, 1});
  EXPECT_EQ(WorldFromParts(body, 0)[0].translation().x(), 1);
  body.body_from_parts = [](double time_s) { return std::vector{Shift(0, time_s, 0)}; };
  EXPECT_EQ(WorldFromParts(body, 2)[0].translation(), Eigen::Vector3d(1, 2, 0));
  body.parts.push_back(body.parts[0]);
  EXPECT_THROW(WorldFromParts(body, 2), std::logic_error) << "a place for each part";
}

}  // namespace
}  // namespace ofm
