#include "ofm/sim/light_baker.h"

#include <gtest/gtest.h>

#include "ofm/sim/test_scene.h"

namespace ofm {
namespace {

/// A floor at z = 0 of 4 m x 4 m, and a lamp 2 m above its middle.
Body Floor() { return MakeTestBody("", StaticMotion{}, Shape::kRectangle, {2, 2, 0}); }
Lighting OneLamp() { return {{{{0, 0, 2}, {0.2, 0.2}, 1}}, 0.3}; }

TEST(LightMap, InterpolatesBetweenItsNodesAndHoldsItsEdges) {
  const LightMap map(3, 2, {1, 0.5}, {0, 1, 2, 0, 1, 2});
  EXPECT_NEAR(map.At(-1, 0), 0, 1e-6);
  EXPECT_NEAR(map.At(0, 0.2F), 1, 1e-6);
  EXPECT_NEAR(map.At(0.5F, -0.5F), 1.5, 1e-6);
  EXPECT_NEAR(map.At(7, 0), 2, 2e-3);
  EXPECT_NEAR(map.At(-7, 0), 0, 1e-6);
}

TEST(UnshadowedLight, FallsWithDistanceAndSlant) {
  const Lamp lamp{{0, 0, 2}, {0.3, 0.3}, 1};
  const Eigen::Vector3d up(0, 0, 1);
  EXPECT_NEAR(UnshadowedLight(lamp, {0, 0, 1}, up), 1, 1e-9);
  EXPECT_LT(UnshadowedLight(lamp, {0, 0, 0}, up), 0.35);
  EXPECT_LT(UnshadowedLight(lamp, {1, 0, 1}, up), 0.5);
  EXPECT_EQ(UnshadowedLight(lamp, {0, 0, 1}, -up), 0);
  EXPECT_EQ(UnshadowedLight(lamp, {0, 0, 3}, -up), 0) << "above the lamp";
}

TEST(BakeLight, OpenFloorHasTheLampsLightAndTheAmbient) {
  const BakedLight baked = BakeLight({Floor()}, OneLamp());
  ASSERT_EQ(baked.size(), 1U);
  const LightMap& map = baked.at({0, 0});
  const double expected = 0.3 + UnshadowedLight(OneLamp().lamps[0], {1, 0, 0}, {0, 0, 1});
  EXPECT_NEAR(map.At(1, 0), expected, 0.01);
  EXPECT_GT(map.At(0, 0), map.At(1.9F, 1.9F));
}

TEST(BakeLight, TableThrowsASoftShadow) {
  const Body table = MakeTestBody("", StaticMotion{Shift(0, 0, 1)}, Shape::kBox, {0.5, 0.5, 0.02});
  const BakedLight open = BakeLight({Floor()}, OneLamp());
  const BakedLight under = BakeLight({Floor(), table}, OneLamp());
  EXPECT_EQ(under.size(), 7U) << "the floor and six faces";
  EXPECT_LT(under.at({0, 0}).At(0, 0), 0.31);
  EXPECT_NEAR(under.at({0, 0}).At(1.9F, 0), open.at({0, 0}).At(1.9F, 0), 0.02);
  const float edge = under.at({0, 0}).At(1, 0);
  EXPECT_GT(edge, 0.31);
  EXPECT_LT(edge, open.at({0, 0}).At(1, 0) - 0.02) << "half of the lamp is seen";
}

TEST(BakeLight, CornersAreDarker) {
  const Body wall = MakeTestBody("", StaticMotion{Shift(-2.05, 0, 1)}, Shape::kBox, {0.05, 2, 1});
  const BakedLight baked = BakeLight({Floor(), wall}, {OneLamp().lamps, 0.3});
  const BakedLight open = BakeLight({Floor()}, OneLamp());
  EXPECT_LT(baked.at({0, 0}).At(-1.95F, 0), open.at({0, 0}).At(-1.95F, 0) - 0.08);
}

TEST(BakeLight, WhatMovesOrGlowsNeitherHasAMapNorThrowsAShadow) {
  Body lamp = MakeTestBody("", StaticMotion{Shift(0, 0, 1)}, Shape::kBox, {0.5, 0.5, 0.02});
  lamp.parts[0].glow = 1;
  const Body walker = MakeTestBody("person", SweepMotion{}, Shape::kBox, {0.5, 0.5, 1});
  const BakedLight baked = BakeLight({Floor(), lamp, walker}, OneLamp());
  EXPECT_EQ(baked.size(), 1U);
  EXPECT_GT(baked.at({0, 0}).At(0, 0), 0.6);
}

}  // namespace
}  // namespace ofm
