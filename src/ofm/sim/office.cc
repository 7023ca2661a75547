#include "ofm/sim/office.h"

#include <numbers>

#include "ofm/sim/furniture.h"
#include "ofm/sim/walls.h"

namespace ofm {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kLeft_m = -3.4, kRight_m = 3.4, kFront_m = -2.8, kBack_m = 4.0, kHeight_m = 2.7;
constexpr double kDesk_m = 0.74;

/// What is seen through the door, whose middle is at `door`: a piece of a passage.
void AddPassage(SceneKit& kit, const Vector2d& door) {
  constexpr double kHalfLength_m = 2.5, kWidth_m = 0.9;
  const TexturePtr wall = kit.Paint(Material::kPlaster, {150, 165, 140});
  const Vector2d from = door - Vector2d(kHalfLength_m, kWidth_m);
  const Vector2d to = door + Vector2d(kHalfLength_m, 0);
  AddFloor(kit, {from, to, 0, kit.Paint(Material::kTiles, {170, 170, 165})});
  AddCeiling(kit, {from, to, kHeight_m, kit.Paint(Material::kCeiling, {218, 222, 222})});
  kit.Add("", Placed({door.x(), from.y(), kHeight_m / 2}),
          {kit.Box({kHalfLength_m, 0.02, kHeight_m / 2}, {}, wall)});
  for (const double x : {from.x(), to.x()}) {
    kit.Add("", Placed({x, door.y() - kWidth_m / 2, kHeight_m / 2}),
            {kit.Box({0.02, kWidth_m / 2, kHeight_m / 2}, {}, wall)});
  }
}

void AddShell(SceneKit& kit) {
  const TexturePtr wall = kit.Paint(Material::kPlaster, {196, 208, 212});
  const TexturePtr accent = kit.Paint(Material::kPlaster, {150, 165, 140});
  const double l = kLeft_m - 0.05, r = kRight_m + 0.05, f = kFront_m - 0.05, b = kBack_m + 0.05;
  AddFloor(kit, {{l, f}, {r, b}, 0, kit.Paint(Material::kCarpet, {125, 105, 95})});
  AddCeiling(kit, {{l, f}, {r, b}, kHeight_m, kit.Paint(Material::kCeiling, {218, 222, 222})});
  AddWall(kit, {{l, b}, {r, b}, kHeight_m, {{2.6, 4.4, 0.95, 2.3}}, accent});
  AddWall(kit, {{r, b}, {r, f}, kHeight_m, {}, wall});
  AddWall(kit, {{r, f}, {l, f}, kHeight_m, {{1.0, 1.95, 0, 2.05}}, wall});
  AddWall(kit, {{l, f}, {l, b}, kHeight_m, {}, wall});
  Part view = kit.Sheet(1.8, 1.35, Upright({kLeft_m + 3.45, b - 0.02, 1.625}, -0.5 * kPi),
                        kit.PaintPrint(Print::kWindow, 1.8, 1.35));
  view.glow = 0.3;  // the room's light is added
  kit.Add("", {}, {view});
  AddDoor(kit, {{r - 1.0, f}, kPi, 0.95, 2.03, {}});
  AddPassage(kit, {r - 1.5, f});
}

void AddFurniture(SceneKit& kit) {
  for (const auto& [x, yaw] : {std::pair{-0.83, 0.0}, {0.83, kPi}}) {
    const RigidTransform desk = Placed({x, 1.5, 0}, yaw);
    AddDesk(kit, desk, {1.6, 0.8, kDesk_m});
    AddWorkplace(kit, desk, kDesk_m);
  }
  AddBookcase(kit, Placed({-2.3, kBack_m, 0}, -0.5 * kPi), {0.3, 1.5, 2.0});
  AddBookcase(kit, Placed({2.2, kBack_m, 0}, -0.5 * kPi), {0.3, 1.2, 1.6});
  AddBookcase(kit, Placed({kLeft_m, 0.2, 0}, 0), {0.3, 1.3, 2.0});
  AddCabinet(kit, Placed({kRight_m, 0.6, 0}, kPi));
  AddCabinet(kit, Placed({kRight_m, 1.1, 0}, kPi));
  AddPlant(kit, {2.9, 2.9, 0}, 1.35);
  AddPlant(kit, {-2.95, -2.35, 0}, 1.1);
  AddSofa(kit, Placed({-0.9, kFront_m, 0}, 0.5 * kPi));
  AddCartons(kit, {-2.95, 2.3, 0});
  AddBin(kit, {1.85, 1.25, 0});
  AddBin(kit, {-1.9, 1.9, 0});
}

void AddPictures(SceneKit& kit) {
  const auto hang = [&kit](Print print, const Vector3d& centre, double yaw, double w, double h) {
    AddPicture(kit, print, centre, yaw, {w, h});
  };
  hang(Print::kPoster, {1.2, kBack_m - 0.01, 1.75}, -0.5 * kPi, 0.5, 0.7);
  hang(Print::kDocument, {-1.25, kBack_m - 0.01, 1.6}, -0.5 * kPi, 0.42, 0.6);
  hang(Print::kPoster, {2.3, kBack_m - 0.01, 2.05}, -0.5 * kPi, 0.8, 0.55);
  hang(Print::kPoster, {kLeft_m + 0.01, 1.9, 1.6}, 0, 0.9, 0.65);
  hang(Print::kDocument, {kLeft_m + 0.01, 2.9, 1.55}, 0, 1.1, 0.8);
  hang(Print::kPoster, {kLeft_m + 0.01, -1.4, 1.6}, 0, 0.6, 0.85);
  hang(Print::kPoster, {kRight_m - 0.01, 2.1, 1.6}, kPi, 0.6, 0.85);
  hang(Print::kDocument, {kRight_m - 0.01, -0.3, 1.5}, kPi, 1.2, 0.8);
  hang(Print::kPoster, {kRight_m - 0.01, 0.85, 1.95}, kPi, 0.7, 0.5);
  hang(Print::kPoster, {-0.9, kFront_m + 0.01, 1.65}, 0.5 * kPi, 1.1, 0.75);
  hang(Print::kDocument, {0.7, kFront_m + 0.01, 1.5}, 0.5 * kPi, 0.5, 0.7);
}

PeoplePlaces Places() {
  PeoplePlaces places;
  places.graph.places = {{-2.0, -0.15}, {0, -0.1},   {2.0, -0.15}, {2.3, 1.5},  {2.2, 2.9},
                         {0.0, 2.9},    {-2.2, 2.9}, {-2.3, 1.5},  {2.3, -1.7}, {-2.4, -1.6}};
  places.graph.ways = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5},
                       {5, 6}, {6, 7}, {7, 0}, {2, 8}, {0, 9}};
  places.stops = {0, 1, 2, 0, 2, 3, 7, 5, 4};
  places.seats = {{{-0.83, 0.78}, 0.5 * kPi}, {{0.83, 2.22}, -0.5 * kPi}};
  places.starts = {{-2.0, -0.15}, {2.3, 1.5}, {0.0, 2.9}};
  places.has_carrier = true;
  return places;
}

}  // namespace

Scene MakeOffice(const FurnishedPlan& plan) {
  SceneKit kit(plan.seed);
  AddShell(kit);
  AddFurniture(kit);
  AddPictures(kit);
  for (const double x : {-1.7, 1.7}) {
    for (const double y : {-1.2, 0.9, 3.0}) {
      kit.AddLamp({{x, y, kHeight_m - 0.06}, {0.3, 0.6}, 1.6});
    }
  }
  const Viewpoint viewpoint{
      {0, -1.1, 1.4},
      {0, 1.5, 0.95},
      {{-1.4, -1.6}, {1.5, -1.6}, {2.2, -0.1}, {2.35, 2.9}, {-2.3, 2.95}, {-2.4, -0.2}}};
  AddPeople(kit, Places(), plan, viewpoint);
  return kit.Build(viewpoint);
}

}  // namespace ofm
