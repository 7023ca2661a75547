#include "ofm/sim/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "ofm/sim/test_scene.h"

namespace ofm {
namespace {

/// Depth along the ray (x, y, 1) to the nearest of `surfaces`; infinite where it meets none.
float CastRay(const std::vector<Surface>& surfaces, float x, float y) {
  float depth = std::numeric_limits<float>::infinity();
  int hit = -1;
  for (int k = 0; k < static_cast<int>(surfaces.size()); ++k) {
    IntersectSpan(surfaces[k], k, {&x, &y, &depth, &hit, 1});
  }
  return depth;
}

std::vector<Surface> SurfacesOf(const Body& body, double time_s = 0) {
  // The scene may go: the surfaces refer to textures alone, which `body` keeps.
  return MakeSurfaces(Scene({body}, {}), time_s, {});
}

TEST(Surface, RayMeetsAWallAtItsDepth) {
  const Body wall = MakeTestWall();
  EXPECT_FLOAT_EQ(CastRay(SurfacesOf(wall), 0, 0), 4);
  EXPECT_FLOAT_EQ(CastRay(SurfacesOf(wall), 0.5F, -0.3F), 4);
  EXPECT_TRUE(std::isinf(CastRay(SurfacesOf(wall), 2.6F, 0)));
}

TEST(Surface, SlantedRectangleIsMetWhereGeometrySays) {
  Body floor = MakeTestWall();
  // The plane through (0, 0, 4) turned by 45 degrees about y: x + z = 4, so z (x + 1) = 4.
  const Eigen::Quaterniond turn = ExpSo3({0, std::numbers::pi / 4, 0});
  floor.motion = StaticMotion{{turn, Eigen::Vector3d(0, 0, 4)}};
  for (const float x : {-0.4F, 0.0F, 0.3F}) {
    EXPECT_NEAR(CastRay(SurfacesOf(floor), x, 0.1F), 4 / (1 + x), 2e-6) << x;
  }
}

TEST(Surface, BoxShowsOnlyItsNearFaces) {
  const Body box = MakeTestBody("box", StaticMotion{Shift(1, 0, 3)}, Shape::kBox, {0.5, 0.4, 0.3});
  const std::vector<Surface> surfaces = SurfacesOf(box);
  EXPECT_EQ(surfaces.size(), 2U) << "front and left";
  EXPECT_FLOAT_EQ(CastRay(surfaces, 0.3F, 0), 2.7F);
  EXPECT_NEAR(CastRay(surfaces, 0.16F, 0), 0.5 / 0.16, 1e-5) << "the left face is at x = 0.5";
  EXPECT_TRUE(std::isinf(CastRay(surfaces, 0.1F, 0)));
}

TEST(Surface, EllipsoidIsMetAtItsNearSide) {
  const Body ball =
      MakeTestBody("sports ball", StaticMotion{Shift(0, 0, 3)}, Shape::kEllipsoid, {1, 0.5, 0.25});
  const std::vector<Surface> surfaces = SurfacesOf(ball);
  EXPECT_FLOAT_EQ(CastRay(surfaces, 0, 0), 2.75F);
  const float z = CastRay(surfaces, 0.2F, 0.05F);
  const Eigen::Array3d on_unit_sphere(0.2 * z / 1, 0.05 * z / 0.5, (z - 3) / 0.25);
  EXPECT_NEAR(on_unit_sphere.square().sum(), 1, 1e-5);
  EXPECT_LT(z, 3);
  EXPECT_TRUE(std::isinf(CastRay(surfaces, 0, 0.2F)));
}

TEST(Surface, CylinderIsMetOnItsMantleAndItsEnd) {
  // Its axis is the camera's z axis at first, then the camera's y axis.
  Body can = MakeTestBody("cup", StaticMotion{Shift(0, 0, 3)}, Shape::kCylinder, {0.4, 0.2, 0.5});
  EXPECT_FLOAT_EQ(CastRay(SurfacesOf(can), 0, 0), 2.5F) << "the end";
  EXPECT_FLOAT_EQ(CastRay(SurfacesOf(can), 0.12F, 0.03F), 2.5F);
  EXPECT_TRUE(std::isinf(CastRay(SurfacesOf(can), 0.17F, 0)));
  can.motion = StaticMotion{{ExpSo3({std::numbers::pi / 2, 0, 0}), Eigen::Vector3d(0, 0, 3)}};
  EXPECT_NEAR(CastRay(SurfacesOf(can), 0, 0.1F), 2.8F, 1e-6) << "the mantle";
  EXPECT_TRUE(std::isinf(CastRay(SurfacesOf(can), 0, 0.19F)));
  EXPECT_TRUE(std::isinf(CastRay(SurfacesOf(can), 0.15F, 0)));
}

TEST(Surface, TaperedCylinderIsWiderAtItsUpperEnd) {
  Body cone = MakeTestBody("cup", {}, Shape::kCylinder, {0.3, 0.3, 0.5});
  cone.parts[0].taper = 0.5;
  // The cylinder's upper end looks up: towards -y of the camera.
  cone.motion = StaticMotion{{ExpSo3({std::numbers::pi / 2, 0, 0}), Eigen::Vector3d(0, 0, 3)}};
  const std::vector<Surface> surfaces = SurfacesOf(cone);
  const float above = CastRay(surfaces, 0, -0.1F), below = CastRay(surfaces, 0, 0.1F);
  EXPECT_LT(above, 2.7F);
  EXPECT_GT(below, 2.7F);
  EXPECT_NEAR(3 - above, 0.3 * (1 + 0.5 * 0.1 * above / 0.5), 1e-5);
  const ImageBounds& bounds = surfaces[0].bounds;
  EXPECT_GT(bounds.max_x, 0.45 / 3);
}

TEST(Surface, CylinderShadesByItsNormal) {
  Body can = MakeTestBody("cup", {}, Shape::kCylinder, {0.3, 0.3, 0.5});
  can.motion = StaticMotion{{ExpSo3({std::numbers::pi / 2, 0, 0}), Eigen::Vector3d(0, 0, 3)}};
  Surface surface = SurfacesOf(can)[0];
  surface.texture_offset_m = {0, 0};
  surface.light_in_camera = {0, 0, -1};
  const float lit = ShadeSurface(surface, {0, 0}, 2.7F, 10).sum();
  surface.light_in_camera = {0, 0, 1};
  EXPECT_NEAR(lit / ShadeSurface(surface, {0, 0}, 2.7F, 10).sum(), 1 / 0.55, 1e-3);
}

TEST(Surface, WhatIsBehindTheCameraIsLeftOut) {
  const Body box = MakeTestBody("box", StaticMotion{Shift(0, 0, -3)}, Shape::kBox, {1, 1, 1});
  const Body ball = MakeTestBody("b", StaticMotion{Shift(0, 0, -3)}, Shape::kEllipsoid, {1, 1, 1});
  EXPECT_TRUE(SurfacesOf(box).empty());
  EXPECT_TRUE(SurfacesOf(ball).empty());
}

TEST(Surface, BoundsHoldAllThatRaysMeet) {
  const Body ball =
      MakeTestBody("b", StaticMotion{Shift(0.3, -0.2, 2)}, Shape::kEllipsoid, {0.3, 0.2, 0.5});
  const std::vector<Surface> surfaces = SurfacesOf(ball);
  const ImageBounds& bounds = surfaces[0].bounds;
  int hits = 0;
  for (float y = -1; y < 1; y += 0.01F) {
    for (float x = -1; x < 1; x += 0.01F) {
      if (std::isinf(CastRay(surfaces, x, y))) continue;
      ++hits;
      EXPECT_TRUE(x >= bounds.min_x && x <= bounds.max_x && y >= bounds.min_y && y <= bounds.max_y);
    }
  }
  EXPECT_GT(hits, 100);
  EXPECT_LT((bounds.max_x - bounds.min_x) * (bounds.max_y - bounds.min_y), 0.5);
}

TEST(Surface, BoundsOfAFloorUnderTheCameraReachItsNearPart) {
  Body floor = MakeTestBody("", StaticMotion{}, Shape::kRectangle, {5, 5, 0});
  floor.motion = StaticMotion{{ExpSo3({std::numbers::pi / 2, 0, 0}), Eigen::Vector3d(0, 1, 0)}};
  const std::vector<Surface> surfaces = SurfacesOf(floor);
  ASSERT_EQ(surfaces.size(), 1U);
  EXPECT_GT(surfaces[0].bounds.max_y, 10);
  EXPECT_NEAR(CastRay(surfaces, 0, 2), 0.5, 1e-6);
}

TEST(Surface, NearerSurfaceHidesTheFarther) {
  const Scene scene(
      {MakeTestBody("box", StaticMotion{Shift(0, 0, 2)}, Shape::kBox, {0.5, 0.5, 0.5}),
       MakeTestWall()},
      {});
  const std::vector<Surface> surfaces = MakeSurfaces(scene, 0, {});
  EXPECT_FLOAT_EQ(CastRay(surfaces, 0, 0), 1.5F);
  EXPECT_FLOAT_EQ(CastRay(surfaces, 0.5F, 0), 4);
}

TEST(Surface, GlowAndLightMapsDecideTheBrightness) {
  const Body wall = MakeTestWall();
  Surface surface = SurfacesOf(wall)[0];
  const LightMap map(2, 2, {10, 10}, {0.25F, 0.25F, 0.25F, 0.25F});
  surface.light_map = &map;
  const float dim = ShadeSurface(surface, {0.1F, 0.1F}, 4, 0.002F).sum();
  surface.glow = 0.5;
  EXPECT_NEAR(ShadeSurface(surface, {0.1F, 0.1F}, 4, 0.002F).sum() / dim, 3, 1e-4);
}

TEST(Surface, SurfaceTurnedToTheLightIsBrighter) {
  const Body wall = MakeTestWall();
  Surface surface = SurfacesOf(wall)[0];
  surface.light_in_camera = {0, 0, -1};
  const float lit = ShadeSurface(surface, {0.1F, 0.1F}, 4, 0.002F).sum();
  surface.light_in_camera = {0, 0, 1};
  const float shadow = ShadeSurface(surface, {0.1F, 0.1F}, 4, 0.002F).sum();
  EXPECT_NEAR(lit / shadow, 1 / 0.55, 1e-4);
}

TEST(Surface, TextureBeginsWhereThePartSays) {
  Body wall = MakeTestWall();
  const float shift = 0.4F;
  const Eigen::Array3f before = ShadeSurface(SurfacesOf(wall)[0], {shift / 4, 0.1F}, 4, 0);
  const Eigen::Array3f elsewhere = ShadeSurface(SurfacesOf(wall)[0], {0, 0.1F}, 4, 0);
  wall.parts[0].texture_offset_m = {shift, 0};
  const Eigen::Array3f after = ShadeSurface(SurfacesOf(wall)[0], {0, 0.1F}, 4, 0);
  EXPECT_LE((after - before).abs().maxCoeff(), 2);
  EXPECT_GT((elsewhere - before).abs().maxCoeff(), 5);
}

TEST(Surface, MovingBodyIsElsewhereLater) {
  const Body box =
      MakeTestBody("box", SweepMotion{{0, 0, 2}, {1.5, 0, 0}, 4, 0}, Shape::kBox, {0.3, 0.3, 0.3});
  EXPECT_FALSE(std::isinf(CastRay(SurfacesOf(box, 0), 0, 0)));
  EXPECT_TRUE(std::isinf(CastRay(SurfacesOf(box, 1), 0, 0)));
}

}  // namespace
}  // namespace ofm
