#include "ofm/sim/scene_kit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <opencv2/core.hpp>

#include "ofm/sim/furniture.h"
#include "ofm/sim/walls.h"

namespace ofm {
namespace {

using Eigen::Vector3d;

/// Least and greatest corner of all parts' boxes.
Eigen::AlignedBox3d BoundsOf(const Scene& scene) {
  Eigen::AlignedBox3d bounds;
  for (const Body& body : scene.bodies()) {
    const std::vector<RigidTransform> places = WorldFromParts(body, 0);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Vector3d reach = places[k].RotationMatrix().cwiseAbs() * body.parts[k].half_extent_m;
      bounds.extend(Vector3d(places[k].translation() - reach));
      bounds.extend(Vector3d(places[k].translation() + reach));
    }
  }
  return bounds;
}

TEST(SceneKit, PaintsEachMaterialOnceAndWhateverWasDrawnBefore) {
  SceneKit a(1), b(1);
  b.Paint(Material::kCarpet);
  b.Uniform(0, 1);
  const TexturePtr wood = a.Paint(Material::kWood, {90, 120, 150});
  EXPECT_EQ(wood, a.Paint(Material::kWood, {90, 120, 150}));
  EXPECT_NE(wood, a.Paint(Material::kWood, {91, 120, 150}));
  EXPECT_EQ(cv::norm(wood->image(), b.Paint(Material::kWood, {90, 120, 150})->image()), 0);
}

TEST(SceneKit, StreamsDoNotDependOnOneAnother) {
  SceneKit a(1), b(1);
  a.Uniform(0, 1);
  a.BeginStream(5);
  b.BeginStream(5);
  EXPECT_EQ(a.Uniform(0, 1), b.Uniform(0, 1));
  EXPECT_LT(a.Index(3), 3);
}

TEST(SceneKit, UprightLooksAlongItsNormal) {
  const RigidTransform place = Upright({1, 2, 3}, 0.5 * std::numbers::pi);
  EXPECT_LT((place.rotation() * Vector3d::UnitZ() - Vector3d::UnitY()).norm(), 1e-9);
  EXPECT_LT((place.rotation() * Vector3d::UnitY() - Vector3d::UnitZ()).norm(), 1e-9);
}

TEST(SceneKit, LampsLightTheScene) {
  SceneKit kit(1);
  kit.AddLamp({{0, 0, 2.5}, {0.3, 0.3}, 1});
  const Scene scene = kit.Build({});
  EXPECT_EQ(scene.lighting().lamps.size(), 1U);
  EXPECT_GT(scene.bodies()[0].parts[0].glow, 0);
}

TEST(Furniture, StandsOnTheFloorWithinItsSize) {
  const auto bounds = [](auto&& add) {
    SceneKit kit(1);
    add(kit);
    return BoundsOf(kit.Build({}));
  };
  const auto desk = bounds([](SceneKit& kit) { AddDesk(kit, {}, {1.6, 0.8, 0.74}); });
  EXPECT_NEAR(desk.min().z(), 0, 1e-9);
  EXPECT_NEAR(desk.max().z(), 0.74, 1e-9);
  EXPECT_NEAR(desk.sizes().x(), 1.6, 1e-9);
  const auto bookcase = bounds([](SceneKit& kit) { AddBookcase(kit, {}, {0.3, 1.2, 2}); });
  EXPECT_GE(bookcase.min().x(), -1e-9);
  EXPECT_NEAR(bookcase.max().z(), 2, 0.02);
  EXPECT_LT(bookcase.max().x(), 0.31);
  const auto chair = bounds([](SceneKit& kit) { kit.Add("chair", {}, MakeChair(kit)); });
  EXPECT_NEAR(chair.min().z(), 0, 1e-9);
  EXPECT_NEAR(chair.max().z(), 1.03, 1e-9);
  for (const auto& add : {AddSofa, AddCabinet}) {
    const auto box = bounds([&](SceneKit& kit) { add(kit, {}); });
    EXPECT_NEAR(box.min().z(), 0, 0.06);
    EXPECT_LT(box.max().z(), 1.7);
    EXPECT_GE(box.min().x(), -0.2);
  }
  const auto plant = bounds([](SceneKit& kit) { AddPlant(kit, {0, 0, 0}, 1.2); });
  EXPECT_NEAR(plant.max().z(), 1.2, 0.3);
}

TEST(Furniture, WorkplaceHasWhatOneWorksWith) {
  SceneKit kit(1);
  AddWorkplace(kit, {}, 0.74);
  const Scene scene = kit.Build({});
  for (const char* name : {"tv", "keyboard", "mouse", "book", "cup", "bottle"}) {
    const auto& names = scene.class_names();
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  }
  EXPECT_GE(BoundsOf(scene).min().z(), 0.7);
}

TEST(Walls, LeaveTheirOpeningsFree) {
  SceneKit kit(1);
  AddWall(kit, {{0, 0}, {5, 0}, 2.7, {{1, 2}, {3, 4, 1, 2}}, kit.Paint(Material::kPlaster)});
  const Scene scene = kit.Build({});
  const auto is_solid = [&scene](const Vector3d& point) {
    for (const Body& body : scene.bodies()) {
      const std::vector<RigidTransform> places = WorldFromParts(body, 0);
      for (std::size_t k = 0; k < places.size(); ++k) {
        const Vector3d inside = places[k].Inverse() * point;
        if ((inside.cwiseAbs() - body.parts[k].half_extent_m).maxCoeff() < 1e-9) return true;
      }
    }
    return false;
  };
  EXPECT_TRUE(is_solid({0.5, 0, 1}));
  EXPECT_FALSE(is_solid({1.5, 0, 1})) << "the doorway";
  EXPECT_TRUE(is_solid({1.5, 0, 2.4})) << "its lintel";
  EXPECT_FALSE(is_solid({3.5, 0, 1.5})) << "the window";
  EXPECT_TRUE(is_solid({3.5, 0, 0.5}));
  EXPECT_TRUE(is_solid({4.9, 0, 2.6}));
}

TEST(Walls, FloorIsSeenFromAboveAndCeilingFromBelow) {
  SceneKit kit(1);
  const TexturePtr paint = kit.Paint(Material::kCarpet);
  AddFloor(kit, {{0, 0}, {4, 2}, 0, paint});
  AddCeiling(kit, {{0, 0}, {4, 2}, 2.7, paint});
  const Scene scene = kit.Build({});
  EXPECT_GT(WorldFromParts(scene.bodies()[0], 0)[0].RotationMatrix()(2, 2), 0.99);
  EXPECT_LT(WorldFromParts(scene.bodies()[1], 0)[0].RotationMatrix()(2, 2), -0.99);
  const Eigen::AlignedBox3d bounds = BoundsOf(scene);
  EXPECT_NEAR(bounds.max().x(), 4, 1e-9);
  EXPECT_NEAR(bounds.max().y(), 2, 1e-9);
}

}  // namespace
}  // namespace ofm
