#include "ofm/sim/corridor.h"

#include <numbers>

#include "ofm/sim/furniture.h"
#include "ofm/sim/walls.h"

namespace ofm {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kHeight_m = 2.7, kDesk_m = 0.74;
constexpr double kSouth_m = -0.05, kMiddle_m = 1.95, kNorth_m = 6.05;  // middle planes of walls
constexpr double kFirst_m = 4, kSecond_m = 8;                          // between the rooms
constexpr double kWest_m = -0.05, kEast_m = 12.05;

void AddShell(SceneKit& kit) {
  const TexturePtr white = kit.Paint(Material::kPlaster, {198, 208, 212});
  const TexturePtr green = kit.Paint(Material::kPlaster, {160, 190, 165});
  const TexturePtr blue = kit.Paint(Material::kPlaster, {200, 180, 155});
  const TexturePtr yellow = kit.Paint(Material::kPlaster, {140, 190, 215});
  AddWall(kit, {{kWest_m, kSouth_m}, {kEast_m, kSouth_m}, kHeight_m, {}, white});
  AddWall(kit, {{kWest_m, kMiddle_m},
                {kEast_m, kMiddle_m},
                kHeight_m,
                {{1.6, 2.6}, {5.6, 6.5}, {9.6, 10.6}},
                white});
  AddWall(kit,
          {{kWest_m, kNorth_m}, {kFirst_m, kNorth_m}, kHeight_m, {{1.2, 3.0, 0.95, 2.3}}, green});
  AddWall(kit, {{kFirst_m, kNorth_m}, {kSecond_m, kNorth_m}, kHeight_m, {}, blue});
  AddWall(kit,
          {{kSecond_m, kNorth_m}, {kEast_m, kNorth_m}, kHeight_m, {{1.2, 3.0, 0.95, 2.3}}, yellow});
  AddWall(kit, {{kWest_m, kSouth_m}, {kWest_m, kNorth_m}, kHeight_m, {}, green});
  AddWall(kit, {{kFirst_m, kMiddle_m}, {kFirst_m, kNorth_m}, kHeight_m, {{0.5, 1.5}}, green});
  AddWall(kit, {{kSecond_m, kMiddle_m}, {kSecond_m, kNorth_m}, kHeight_m, {{0.5, 1.5}}, blue});
  AddWall(kit, {{kEast_m, kSouth_m}, {kEast_m, kNorth_m}, kHeight_m, {}, yellow});
  AddFloor(
      kit,
      {{kWest_m, kSouth_m}, {kEast_m, kMiddle_m}, 0, kit.Paint(Material::kTiles, {150, 160, 165})});
  AddFloor(
      kit,
      {{kWest_m, kMiddle_m}, {kFirst_m, kNorth_m}, 0, kit.Paint(Material::kCarpet, {95, 110, 90})});
  AddFloor(kit, {{kFirst_m, kMiddle_m},
                 {kSecond_m, kNorth_m},
                 0,
                 kit.Paint(Material::kParquet, {80, 125, 165})});
  AddFloor(kit, {{kSecond_m, kMiddle_m},
                 {kEast_m, kNorth_m},
                 0,
                 kit.Paint(Material::kCarpet, {90, 90, 125})});
  AddCeiling(kit, {{kWest_m, kSouth_m},
                   {kEast_m, kNorth_m},
                   kHeight_m,
                   kit.Paint(Material::kCeiling, {218, 222, 222})});
  for (const double x : {kWest_m + 2.1, kSecond_m + 2.1}) {
    Part view = kit.Sheet(1.8, 1.35, Upright({x, kNorth_m - 0.02, 1.625}, -0.5 * kPi),
                          kit.PaintPrint(Print::kWindow, 1.8, 1.35));
    view.glow = 0.3;  // the room's light is added
    kit.Add("", {}, {view});
  }
}

void AddLamps(SceneKit& kit) {
  for (const double x : {1.5, 4.5, 7.5, 10.5}) {
    kit.AddLamp({{x, 0.95, kHeight_m - 0.06}, {0.6, 0.15}, 1.5});
  }
  for (const double x : {1.1, 2.9, 5.1, 6.9, 9.1, 10.9}) {
    kit.AddLamp({{x, 4.0, kHeight_m - 0.06}, {0.3, 0.6}, 1.7});
  }
}

void FurnishCorridor(SceneKit& kit) {
  AddBookcase(kit, Placed({3.4, 0, 0}, 0.5 * kPi), {0.28, 1.0, 1.3});
  AddPlant(kit, {7.3, 0.25, 0}, 1.1);
  AddCabinet(kit, Placed({8.9, 0, 0}, 0.5 * kPi));
  AddPlant(kit, {0.3, 0.3, 0}, 1.3);
  AddCartons(kit, {11.6, 0.35, 0});
  for (const auto& [x, print] : {std::pair{1.3, Print::kPoster},
                                 {2.4, Print::kDocument},
                                 {4.8, Print::kPoster},
                                 {6.2, Print::kDocument},
                                 {8.1, Print::kPoster},
                                 {10.0, Print::kPoster},
                                 {11.1, Print::kDocument}}) {
    AddPicture(kit, print, {x, 0.01, 1.6}, 0.5 * kPi, {0.75, 0.55});
  }
  for (const double x : {0.7, 3.4, 4.8, 7.4, 8.5, 11.2}) {
    AddPicture(kit, Print::kPoster, {x, 1.89, 1.55}, -0.5 * kPi, {0.5, 0.7});
  }
  AddPicture(kit, Print::kPoster, {0.01, 0.95, 1.6}, 0, {0.9, 0.65});
  AddPicture(kit, Print::kPoster, {11.99, 0.95, 1.6}, kPi, {0.9, 0.65});
}

void FurnishMeetingRoom(SceneKit& kit) {
  AddDesk(kit, Placed({1.7, 4.6, 0}), {2.0, 1.0, kDesk_m});
  AddWorkplace(kit, Placed({1.7, 4.7, 0}), kDesk_m);
  AddBookcase(kit, Placed({0, 3.2, 0}, 0), {0.3, 1.4, 2.0});
  AddPicture(kit, Print::kScreen, {0.01, 4.9, 1.5}, 0, {1.3, 0.8});
  AddPicture(kit, Print::kPoster, {3.94, 4.6, 1.6}, kPi, {0.9, 0.65});
  AddPlant(kit, {3.6, 5.6, 0}, 1.2);
}

void FurnishOffice(SceneKit& kit) {
  for (const double x : {5.05, 6.75}) {
    AddDesk(kit, Placed({x, 5.5, 0}), {1.5, 0.75, kDesk_m});
    AddWorkplace(kit, Placed({x, 5.5, 0}), kDesk_m);
  }
  AddPicture(kit, Print::kPoster, {5.0, 5.99, 1.7}, -0.5 * kPi, {0.9, 0.65});
  AddPicture(kit, Print::kDocument, {6.1, 5.99, 1.75}, -0.5 * kPi, {0.45, 0.6});
  AddPicture(kit, Print::kPoster, {7.1, 5.99, 1.7}, -0.5 * kPi, {0.8, 0.6});
  AddBookcase(kit, Placed({4.06, 4.4, 0}, 0), {0.3, 1.2, 2.0});
  AddBookcase(kit, Placed({7.94, 4.5, 0}, kPi), {0.3, 1.3, 1.6});
  AddCartons(kit, {4.5, 3.9 - 1.55, 0});
  AddBin(kit, {5.9, 5.6, 0});
  AddPicture(kit, Print::kPoster, {7.2, 2.01, 1.6}, 0.5 * kPi, {0.6, 0.85});
}

void FurnishLounge(SceneKit& kit) {
  AddSofa(kit, Placed({11.99, 3.9, 0}, kPi));
  AddDesk(kit, Placed({10.6, 4.6, 0}), {0.9, 0.6, 0.5});
  AddBookcase(kit, Placed({8.06, 4.6, 0}, 0), {0.3, 1.2, 1.3});
  AddPicture(kit, Print::kPoster, {11.99, 3.9, 1.65}, kPi, {1.2, 0.8});
  AddPicture(kit, Print::kScreen, {8.36, 5.6, 1.5}, -0.25 * kPi, {0.9, 0.55});
  AddPlant(kit, {11.6, 5.6, 0}, 1.4);
  AddPlant(kit, {11.6, 2.4, 0}, 1.0);
  AddCabinet(kit, Placed({8.9, 6.0, 0}, -0.5 * kPi));
}

PeoplePlaces Places() {
  PeoplePlaces places;
  places.graph.places = {{0.9, 1.05},  {2.1, 1.05}, {4.0, 1.1},  {6.05, 1.1},      {8.0, 1.1},
                         {10.1, 1.05}, {11.3, 1.0}, {2.1, 2.9},  {1.0, 3.6 - 0.9}, {3.3, 2.95},
                         {4.7, 2.95},  {6.05, 2.9}, {7.3, 2.95}, {5.6, 4.1},       {6.6, 4.1},
                         {8.7, 2.95},  {10.1, 2.9}, {9.3, 4.6}};
  places.graph.ways = {{0, 1},   {1, 2},   {2, 3},   {3, 4},   {4, 5},  {5, 6},   {1, 7},
                       {7, 8},   {7, 9},   {9, 10},  {10, 11}, {11, 3}, {11, 12}, {10, 13},
                       {13, 14}, {14, 12}, {12, 15}, {15, 16}, {16, 5}, {15, 17}};
  places.stops = {0, 6, 8, 10, 12, 13, 14, 16, 3, 17};
  places.seats = {{{5.05, 4.78}, 0.5 * kPi}, {{6.75, 4.78}, 0.5 * kPi}, {{1.7, 3.85}, 0.5 * kPi}};
  places.starts = {{4.7, 2.95}, {7.3, 2.95}, {4.0, 1.1}};
  places.has_carrier = true;
  return places;
}

}  // namespace

Scene MakeCorridor(const FurnishedPlan& plan) {
  SceneKit kit(plan.seed);
  AddShell(kit);
  AddLamps(kit);
  FurnishCorridor(kit);
  FurnishMeetingRoom(kit);
  FurnishOffice(kit);
  FurnishLounge(kit);
  const Viewpoint viewpoint{
      {6.0, 2.75, 1.4},
      {5.9, 5.4, 0.95},
      {{1.2, 0.95}, {10.1, 0.95}, {10.1, 2.95}, {6.0, 3.05}, {2.1, 2.95}, {2.1, 0.95}}};
  std::vector<FloorTrack> users;
  for (const ScriptPtr& script : AddPeople(kit, Places(), plan, viewpoint)) {
    users.push_back([script](double time_s) { return script->At(time_s).position; });
  }
  AddDoor(kit, {{kWest_m + 5.6, kMiddle_m}, 0, 0.9, 2.03, users});
  return kit.Build(viewpoint);
}

}  // namespace ofm
