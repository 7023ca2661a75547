#include "ofm/sim/people.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "ofm/sim/furniture.h"

namespace ofm {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

Vector3d OnFloor(const Vector2d& point) { return {point.x(), point.y(), 0}; }

double SmoothStep(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// True where `script` comes too near to something after `from_s`.
bool Collides(const HumanScript& script, double from_s, const std::vector<KeepAway>& away) {
  constexpr double kStep_s = 0.15;
  for (double t = from_s; t < script.end_s(); t += kStep_s) {
    const Vector2d position = script.At(t).position;
    for (const KeepAway& other : away) {
      if ((other.track(t) - position).norm() < other.distance_m) return true;
    }
  }
  return false;
}

/// Lets `script` walk to a place of the graph.
void WalkTo(HumanScript& script, const FloorGraph& graph, int place) {
  std::vector<Vector2d> way;
  const int start = graph.Nearest(script.end_position());
  // Who stands beside the graph goes onto it first; who is on it begins with the second place.
  if ((graph.places[start] - script.end_position()).norm() > 0.05)
    way.push_back(graph.places[start]);
  for (const int next : graph.ShortestWay(start, place)) way.push_back(graph.places[next]);
  if (!way.empty()) script.Walk(way);
}

HumanLook DrawLook(SceneKit& kit) {
  const std::array<cv::Scalar, 6> shirts = {cv::Scalar(60, 60, 190), {170, 110, 60},
                                            {90, 150, 90},           {190, 190, 195},
                                            {60, 150, 200},          {110, 70, 110}};
  const std::array<cv::Scalar, 3> trousers = {
      cv::Scalar(110, 70, 50), {60, 60, 65}, {90, 120, 140}};
  const std::array<cv::Scalar, 3> skins = {
      cv::Scalar(150, 175, 220), {110, 145, 195}, {70, 95, 140}};
  const std::array<cv::Scalar, 4> hairs = {
      cv::Scalar(30, 40, 60), {25, 25, 28}, {70, 120, 170}, {120, 120, 125}};
  const std::array<Material, 3> weaves = {Material::kCloth, Material::kStripes, Material::kPlaid};
  HumanLook look;
  look.height_m = kit.Uniform(1.62, 1.88);
  look.shirt = kit.Paint(weaves[kit.Index(3)], shirts[kit.Index(6)]);
  look.trousers = kit.Paint(Material::kCloth, trousers[kit.Index(3)]);
  look.skin = kit.Paint(Material::kSkin, skins[kit.Index(3)]);
  look.hair = kit.Paint(Material::kHair, hairs[kit.Index(4)]);
  look.shoes = kit.Paint(Material::kPlain, {45, 45, 50});
  return look;
}

ScriptedMotion Follow(const ScriptPtr& script) {
  return {[script](double time_s) {
    const HumanState state = script->At(time_s);
    return Placed(OnFloor(state.position), state.yaw_rad);
  }};
}

void AddBody(SceneKit& kit, const ScriptPtr& script, double carries) {
  const HumanLook look = DrawLook(kit);
  const double phase = kit.Uniform(0, 2 * kPi);
  Body body{{}, "person", Follow(script), MakeHumanParts(kit, look)};
  body.body_from_parts = [script, phase, carries, height = look.height_m](double time_s) {
    return PlaceHumanParts(FindJoints(script->At(time_s), time_s, phase, carries), height);
  };
  kit.Add(std::move(body));
}

}  // namespace

HumanScript PlanWalks(SceneKit& kit, const FloorGraph& graph, const WalkPlan& plan) {
  constexpr int kTries = 12;
  HumanScript script(plan.start, kit.Uniform(-kPi, kPi));
  script.Wait(kit.Uniform(0.1, 0.6));
  int legs_since_rest = kit.Index(2);
  while (script.end_s() < plan.duration_s) {
    const double from_s = script.end_s();
    HumanScript longer = script;
    bool is_free = false;
    for (int k = 0; k < kTries && !is_free; ++k) {
      longer = script;
      if (k > kTries / 2) longer.Wait(kit.Uniform(0.3, 1.5));
      if (plan.seat && legs_since_rest >= 3 && k < 3) {
        WalkTo(longer, graph, graph.Nearest(plan.seat->position));
        longer.SitDown(*plan.seat);
        longer.Wait(kit.Uniform(2.5, 6));
        longer.StandUp();
      } else {
        WalkTo(longer, graph, plan.stops[kit.Index(static_cast<int>(plan.stops.size()))]);
        longer.Wait(kit.Uniform(0.2, 1.2));
      }
      is_free = longer.end_s() > from_s + 1 && !Collides(longer, from_s, plan.away);
    }
    if (is_free) {
      legs_since_rest =
          longer.At(0.5 * (from_s + longer.end_s())).sit > 0 ? 0 : legs_since_rest + 1;
      script = std::move(longer);
    } else {
      script.Wait(0.7);
    }
  }
  return script;
}

void AddHuman(SceneKit& kit, const ScriptPtr& script) { AddBody(kit, script, 0); }

void AddCarrier(SceneKit& kit, const ScriptPtr& script) {
  AddBody(kit, script, 1);
  const Vector3d half(0.15, 0.19, 0.13);
  const ScriptedMotion walker = Follow(script);
  const ScriptedMotion motion{[walker](double time_s) {
    return walker.world_from_body(time_s) * Placed({0.36, 0, 1.12});
  }};
  kit.Add(Body{
      {}, "box", motion, {kit.Box(half, {}, kit.Paint(Material::kCardboard, {110, 150, 185}))}});
}

void AddSeatChair(SceneKit& kit, const Seat& seat, const ScriptPtr& user) {
  constexpr double kPushedBack_m = 0.5;
  const std::vector<Part> parts = MakeChair(kit);
  if (user == nullptr) {
    kit.Add("chair", Placed(OnFloor(seat.position), seat.yaw_rad), parts);
    return;
  }
  const ScriptedMotion motion{[user, seat](double time_s) {
    const HumanState state = user->At(time_s);
    const Vector2d back = kPushedBack_m * (1 - state.sit) * seat.Forward();
    return Placed(OnFloor(seat.position - back), seat.yaw_rad + 0.4 * (1 - state.sit));
  }};
  kit.Add(Body{{}, "chair", motion, parts});
}

void AddDoor(SceneKit& kit, const DoorPlan& plan) {
  const Vector3d half(0.5 * plan.width_m, 0.02, 0.5 * plan.height_m);
  const TexturePtr paint = kit.PaintPrint(Print::kDoor, plan.width_m, plan.height_m);
  const TexturePtr metal = kit.Paint(Material::kPlain, {150, 150, 150});
  const Vector3d middle(half.x(), 0, half.z());
  std::vector<Part> parts = {
      kit.Box(half, Placed(middle), kit.Paint(Material::kWood, {95, 130, 165}))};
  for (const double side : {-1.0, 1.0}) {
    parts.push_back(kit.Sheet(plan.width_m, plan.height_m,
                              Upright(middle + Vector3d(0, side * 0.0205, 0), side * 0.5 * kPi),
                              paint));
    parts.push_back(
        kit.Box({0.06, 0.012, 0.012}, Placed({plan.width_m - 0.1, side * 0.06, 1.02}), metal));
  }
  const auto leaf = [plan](double open) {
    return Placed(OnFloor(plan.hinge), plan.yaw_rad + 0.5 * kPi * 0.95 * open);
  };
  if (plan.users.empty()) {
    kit.Add("door", leaf(1), parts);
    return;
  }
  const ScriptedMotion motion{[plan, leaf](double time_s) {
    constexpr double kShut_m = 1.9, kOpen_m = 1.0;
    const Vector2d middle_on_floor =
        plan.hinge + 0.5 * plan.width_m * Vector2d(std::cos(plan.yaw_rad), std::sin(plan.yaw_rad));
    double nearest = kShut_m;
    for (const FloorTrack& user : plan.users) {
      nearest = std::min(nearest, (user(time_s) - middle_on_floor).norm());
    }
    return leaf(SmoothStep((kShut_m - nearest) / (kShut_m - kOpen_m)));
  }};
  kit.Add(Body{{}, "door", motion, parts});
}

}  // namespace ofm
