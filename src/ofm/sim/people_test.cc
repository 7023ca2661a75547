#include "ofm/sim/people.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ofm {
namespace {

using Eigen::Vector2d;

FloorGraph Square() { return {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}}; }

WalkPlan SquarePlan() { return {{0, 0}, Seat{{2, 5}, 0}, {0, 1, 2, 3}, 60, {}}; }

TEST(PlanWalks, CoversItsTimeAndStaysOnTheWays) {
  SceneKit kit(1);
  WalkPlan plan = SquarePlan();
  plan.seat.reset();
  const HumanScript script = PlanWalks(kit, Square(), plan);
  EXPECT_GE(script.end_s(), 60);
  double way_m = 0;
  for (double t = 0; t < 60; t += 0.1) {
    const Vector2d p = script.At(t).position;
    const double off =
        std::min({std::abs(p.x()), std::abs(p.y()), std::abs(p.x() - 4), std::abs(p.y() - 4)});
    EXPECT_LT(off, 0.2) << t;
    way_m += (script.At(t + 0.1).position - p).norm();
  }
  EXPECT_GT(way_m, 20);
}

TEST(PlanWalks, SitsDownNowAndThen) {
  SceneKit kit(2);
  const HumanScript script = PlanWalks(kit, Square(), SquarePlan());
  int seated = 0;
  for (double t = 0; t < 60; t += 0.5) seated += script.At(t).sit == 1;
  EXPECT_GT(seated, 5);
  EXPECT_LT(seated, 80);
}

TEST(PlanWalks, KeepsAwayFromOthers) {
  SceneKit kit(3);
  WalkPlan plan = SquarePlan();
  plan.seat.reset();
  plan.away = {{[](double) { return Vector2d(4, 2); }, 0.8}};
  const HumanScript script = PlanWalks(kit, Square(), plan);
  for (double t = 0; t < 60; t += 0.1) {
    EXPECT_GT((script.At(t).position - Vector2d(4, 2)).norm(), 0.7) << t;
  }
}

TEST(AddHuman, IsAPersonWhoseRootGoesAsTheScript) {
  SceneKit kit(4);
  auto script = std::make_shared<HumanScript>(Vector2d(1, 2), 0.0);
  script->Walk({{3, 2}});
  AddHuman(kit, script);
  const Scene scene = kit.Build({});
  ASSERT_EQ(scene.mover_count(), 1U);
  EXPECT_EQ(scene.class_names()[1], "person");
  const Body& body = scene.bodies()[0];
  EXPECT_EQ(WorldFromParts(body, 1).size(), body.parts.size());
  EXPECT_NEAR(WorldFromBody(body.motion, 99).translation().x(), 3, 1e-9);
}

TEST(AddCarrier, BringsABoxBeforeTheBody) {
  SceneKit kit(5);
  AddCarrier(kit, std::make_shared<HumanScript>(Vector2d(0, 0), 0.0));
  const Scene scene = kit.Build({});
  ASSERT_EQ(scene.mover_count(), 2U);
  EXPECT_EQ(scene.class_names()[2], "box");
  EXPECT_GT(WorldFromBody(scene.bodies()[1].motion, 0).translation().x(), 0.3);
}

TEST(AddSeatChair, IsPulledUpWhileItsUserSits) {
  const Seat seat{{0, 0}, 0};
  SceneKit kit(6);
  auto script = std::make_shared<HumanScript>(seat);
  script->StandUp();
  AddSeatChair(kit, seat, script);
  AddSeatChair(kit, {{5, 5}, 1}, nullptr);
  const Scene scene = kit.Build({});
  EXPECT_EQ(scene.mover_count(), 1U) << "a chair that nobody uses stands still";
  EXPECT_NEAR(WorldFromBody(scene.bodies()[0].motion, 0).translation().x(), 0, 1e-9);
  EXPECT_LT(WorldFromBody(scene.bodies()[0].motion, 9).translation().x(), -0.4);
}

TEST(AddDoor, OpensBeforeWhoComesAndStandsOpenWithoutAnybody) {
  SceneKit kit(7);
  AddDoor(kit, {{0, 0}, 0, 0.9, 2, {[](double t) { return Vector2d(0.45, 5 - t); }}});
  AddDoor(kit, {{9, 0}, 0, 0.9, 2, {}});
  const Scene scene = kit.Build({});
  const auto angle = [&](int body, double t) {
    return WorldFromBody(scene.bodies()[body].motion, t).RotationAngle();
  };
  EXPECT_NEAR(angle(0, 0), 0, 1e-9);
  EXPECT_GT(angle(0, 5), 1.4);
  EXPECT_GT(angle(1, 0), 1.4);
  EXPECT_EQ(scene.mover_count(), 1U);
}

}  // namespace
}  // namespace ofm
