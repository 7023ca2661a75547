#include "ofm/sim/furniture.h"

#include <array>
#include <numbers>

namespace ofm {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

TexturePtr Oak(SceneKit& kit) { return kit.Paint(Material::kWood, {110, 155, 190}); }
TexturePtr Metal(SceneKit& kit) { return kit.Paint(Material::kPlain, {105, 105, 108}); }
TexturePtr Black(SceneKit& kit) { return kit.Paint(Material::kPlain, {42, 40, 40}); }

cv::Scalar RandomPaint(SceneKit& kit) {
  const std::array<cv::Scalar, 5> colors = {
      cv::Scalar(60, 70, 170), {150, 90, 50}, {70, 140, 70}, {60, 160, 200}, {120, 80, 120}};
  return colors[kit.Index(5)];
}

void AddScreen(SceneKit& kit, const RigidTransform& world_from_foot) {
  constexpr double kWidth_m = 0.54, kHeight_m = 0.33;
  Part image = kit.Sheet(kWidth_m - 0.03, kHeight_m - 0.03, Upright({0, -0.021, 0.3}, -0.5 * kPi),
                         kit.PaintPrint(Print::kScreen, kWidth_m - 0.03, kHeight_m - 0.03));
  image.glow = 0.5;
  kit.Add(
      "tv", world_from_foot,
      {kit.Box({0.12, 0.09, 0.008}, Placed({0, 0.03, 0.008}), Black(kit)),
       kit.Box({0.025, 0.02, 0.09}, Placed({0, 0.04, 0.09}), Black(kit)),
       kit.Box({0.5 * kWidth_m, 0.02, 0.5 * kHeight_m}, Placed({0, 0, 0.3}), Black(kit)), image});
}

/// Books side by side along y from `from_m` to `to_m`, their spines at x = 0 looking along +x.
std::vector<Part> MakeBookRow(SceneKit& kit, double from_m, double to_m, double space_m) {
  const TexturePtr spines = kit.Paint(Material::kSpines);
  std::vector<Part> books;
  for (double y = from_m; y < to_m;) {
    const double thickness = kit.Uniform(0.022, 0.06);
    const double height = kit.Uniform(0.68, 0.95) * space_m;
    const double depth = kit.Uniform(0.16, 0.22);
    if (y + thickness > to_m) break;
    books.push_back(kit.Box({0.5 * height, 0.5 * thickness, 0.5 * depth},
                            {Eigen::Quaterniond(Eigen::AngleAxisd(-0.5 * kPi, Vector3d::UnitY())),
                             Vector3d(-0.5 * depth, y + 0.5 * thickness, 0.5 * height)},
                            spines));
    y += thickness + (kit.Index(7) == 0 ? kit.Uniform(0.04, 0.15) : 0.002);
  }
  return books;
}

}  // namespace

void AddDesk(SceneKit& kit, const RigidTransform& world_from_desk, const Vector3d& size_m) {
  const double x = 0.5 * size_m.x(), y = 0.5 * size_m.y(), z = size_m.z();
  std::vector<Part> parts = {kit.Box({x, y, 0.018}, Placed({0, 0, z - 0.018}), Oak(kit))};
  for (const double side : {-1.0, 1.0}) {
    const double leg_x = side * (x - 0.08);
    parts.push_back(kit.Box({0.03, y - 0.08, 0.015}, Placed({leg_x, 0, 0.015}), Metal(kit)));
    for (const double end : {-1.0, 1.0}) {
      parts.push_back(kit.Box({0.025, 0.025, 0.5 * z - 0.018},
                              Placed({leg_x, end * (y - 0.1), 0.5 * z - 0.018}), Metal(kit)));
    }
  }
  parts.push_back(kit.Box({x - 0.1, 0.01, 0.16}, Placed({0, y - 0.06, z - 0.2}), Oak(kit)));
  kit.Add("dining table", world_from_desk, parts);
}

void AddWorkplace(SceneKit& kit, const RigidTransform& world_from_desk, double desk_height_m) {
  const auto on_desk = [&](double x, double y, double yaw = 0) {
    return world_from_desk * Placed({x, y, desk_height_m}, yaw);
  };
  AddScreen(kit, on_desk(kit.Uniform(-0.12, 0.12), 0.2, kit.Uniform(-0.15, 0.15)));
  const RigidTransform keys = Placed({0, 0, 0.0181});
  kit.Add("keyboard", on_desk(kit.Uniform(-0.08, 0.08), -0.14, kit.Uniform(-0.1, 0.1)),
          {kit.Box({0.22, 0.07, 0.009}, Placed({0, 0, 0.009}), Black(kit)),
           kit.Sheet(0.43, 0.135, keys, kit.PaintPrint(Print::kKeyboard, 0.43, 0.135))});
  kit.Add("mouse", on_desk(0.34, -0.15),
          {kit.Ellipsoid({0.032, 0.055, 0.025}, Placed({0, 0, 0.01}), Black(kit))});
  for (const double side : {-1.0, 1.0}) {
    const Vector3d half(kit.Uniform(0.08, 0.11), kit.Uniform(0.11, 0.15), kit.Uniform(0.012, 0.04));
    kit.Add(
        "book", on_desk(side * kit.Uniform(0.45, 0.58), kit.Uniform(-0.2, 0), kit.Uniform(-1, 1)),
        {kit.Box(half, Placed({0, 0, half.z()}),
                 kit.Paint(side > 0 ? Material::kSpines : Material::kStripes, RandomPaint(kit)))});
  }
  kit.Add(
      "", on_desk(kit.Uniform(-0.38, -0.3), kit.Uniform(-0.12, 0.02), kit.Uniform(-0.4, 0.4)),
      {kit.Sheet(0.21, 0.3, Placed({0, 0, 0.002}), kit.PaintPrint(Print::kDocument, 0.21, 0.3))});
  kit.Add("cup", on_desk(kit.Uniform(0.36, 0.44), kit.Uniform(0.05, 0.2)),
          {kit.Cylinder({0.04, 0.04, 0.048}, Placed({0, 0, 0.048}),
                        kit.Paint(Material::kPlain, RandomPaint(kit)), 0.08)});
  kit.Add("bottle", on_desk(kit.Uniform(-0.6, -0.45), kit.Uniform(0.15, 0.25)),
          {kit.Cylinder({0.036, 0.036, 0.08}, Placed({0, 0, 0.08}),
                        kit.Paint(Material::kPlaid, RandomPaint(kit))),
           kit.Cylinder({0.022, 0.022, 0.045}, Placed({0, 0, 0.2}),
                        kit.Paint(Material::kPlain, {200, 190, 170}), -0.4)});
}

std::vector<Part> MakeChair(SceneKit& kit) {
  const TexturePtr cloth = kit.Paint(Material::kCloth, RandomPaint(kit) * 0.7);
  std::vector<Part> parts = {
      kit.Box({0.23, 0.23, 0.035}, Placed({0, 0, kSeatHeight_m - 0.035}), cloth),
      kit.Box({0.03, 0.21, 0.25}, Placed({-0.24, 0, 0.78}), cloth),
      kit.Box({0.015, 0.03, 0.12}, Placed({-0.26, 0, 0.5}), Black(kit)),
      kit.Cylinder({0.03, 0.03, 0.17}, Placed({0, 0, 0.26}), Metal(kit))};
  for (int k = 0; k < 5; ++k) {
    const double angle = 2 * kPi * k / 5;
    const Vector3d middle(0.14 * std::cos(angle), 0.14 * std::sin(angle), 0.07);
    parts.push_back(kit.Box({0.14, 0.02, 0.02}, Placed(middle, angle), Black(kit)));
    parts.push_back(kit.Ellipsoid({0.03, 0.03, 0.03},
                                  Placed({2 * middle.x(), 2 * middle.y(), 0.03}), Black(kit)));
  }
  for (const double side : {-0.25, 0.25}) {
    parts.push_back(kit.Box({0.13, 0.025, 0.015}, Placed({-0.04, side, 0.67}), Black(kit)));
    parts.push_back(kit.Box({0.02, 0.015, 0.11}, Placed({-0.04, side, 0.55}), Black(kit)));
  }
  return parts;
}

void AddBookcase(SceneKit& kit, const RigidTransform& world_from_case, const Vector3d& size_m) {
  constexpr double kBoard_m = 0.012;
  const TexturePtr wood = kit.Paint(Material::kWood, {80, 115, 150});
  const double depth = size_m.x(), y = 0.5 * size_m.y(), height = size_m.z();
  const int levels = static_cast<int>(height / 0.36);
  const double space = height / levels;
  std::vector<Part> parts = {
      kit.Box({0.005, y, 0.5 * height}, Placed({0.005, 0, 0.5 * height}), wood),
      kit.Box({0.5 * depth, kBoard_m, 0.5 * height}, Placed({0.5 * depth, y, 0.5 * height}), wood),
      kit.Box({0.5 * depth, kBoard_m, 0.5 * height}, Placed({0.5 * depth, -y, 0.5 * height}),
              wood)};
  for (int level = 0; level <= levels; ++level) {
    const double z = std::max(kBoard_m, level * space);
    parts.push_back(kit.Box({0.5 * depth, y, kBoard_m}, Placed({0.5 * depth, 0, z}), wood));
    if (level == levels) break;
    const RigidTransform row = Placed({depth - kit.Uniform(0.02, 0.06), 0, z + kBoard_m});
    kit.Add("book", world_from_case * row,
            MakeBookRow(kit, -y + 0.02, y - kit.Uniform(0.02, 0.4 * y), space - 2 * kBoard_m));
  }
  kit.Add("", world_from_case, parts);
}

void AddCabinet(SceneKit& kit, const RigidTransform& world_from_cabinet) {
  const TexturePtr grey = kit.Paint(Material::kPlain, {165, 160, 150});
  std::vector<Part> parts = {kit.Box({0.24, 0.22, 0.53}, Placed({0.24, 0, 0.53}), grey)};
  for (const double z : {0.19, 0.53, 0.87}) {
    parts.push_back(kit.Box({0.008, 0.2, 0.155}, Placed({0.488, 0, z}), grey));
    parts.push_back(kit.Box({0.012, 0.06, 0.012}, Placed({0.505, 0, z + 0.06}), Black(kit)));
    parts.push_back(kit.Sheet(0.1, 0.05, Upright({0.4965, 0, z - 0.02}, 0),
                              kit.PaintPrint(Print::kDocument, 0.1, 0.05)));
  }
  kit.Add("", world_from_cabinet, parts);
  const RigidTransform top = world_from_cabinet * Placed({0.24, 0, 1.06}, kit.Uniform(-0.4, 0.4));
  if (kit.Index(2) == 0) {
    AddPlant(kit, top.translation(), 0.5);
  } else {
    kit.Add("", top,
            {kit.Box({0.15, 0.18, 0.12}, Placed({0, 0, 0.12}),
                     kit.Paint(Material::kCardboard, {110, 150, 185}))});
  }
}

void AddPlant(SceneKit& kit, const Vector3d& position, double height_m) {
  const double r = 0.2 * height_m;
  const TexturePtr leaves = kit.Paint(Material::kLeaves, {60, 160, 80});
  std::vector<Part> parts = {kit.Cylinder({0.6 * r, 0.6 * r, 0.17 * height_m},
                                          Placed({0, 0, 0.17 * height_m}),
                                          kit.Paint(Material::kPlain, {70, 100, 170}), 0.15)};
  for (int k = 0; k < 9; ++k) {
    const double angle = 2.4 * k, out = r * (0.35 + 0.09 * k);
    const Vector3d at(out * std::cos(angle), out * std::sin(angle),
                      height_m * (0.88 - 0.055 * k) + kit.Uniform(-0.03, 0.03));
    const Vector3d axis(kit.Uniform(-0.6, 0.6), kit.Uniform(-0.6, 0.6), angle);
    parts.push_back(
        kit.Ellipsoid(height_m * Vector3d(0.2, 0.09, 0.05), {ExpSo3(axis), at}, leaves));
  }
  kit.Add("potted plant", Placed(position), parts);
}

void AddSofa(SceneKit& kit, const RigidTransform& world_from_sofa) {
  const TexturePtr cloth = kit.Paint(Material::kCloth, {110, 80, 60});
  std::vector<Part> parts = {kit.Box({0.42, 0.95, 0.15}, Placed({0.42, 0, 0.2}), cloth),
                             kit.Box({0.12, 0.95, 0.4}, Placed({0.12, 0, 0.42}), cloth)};
  for (const double side : {-1.0, 1.0}) {
    parts.push_back(kit.Box({0.42, 0.1, 0.3}, Placed({0.42, side * 0.95, 0.3}), cloth));
    parts.push_back(kit.Box({0.3, 0.4, 0.06}, Placed({0.52, side * 0.42, 0.4}), cloth));
    parts.push_back(kit.Box({0.06, 0.2, 0.2}, Placed({0.3, side * 0.6, 0.62}, side * 0.3),
                            kit.Paint(Material::kPlaid, RandomPaint(kit))));
  }
  kit.Add("couch", world_from_sofa, parts);
}

void AddBin(SceneKit& kit, const Vector3d& position) {
  kit.Add("", Placed(position),
          {kit.Cylinder({0.13, 0.13, 0.16}, Placed({0, 0, 0.16}),
                        kit.Paint(Material::kPlain, {70, 65, 60}), 0.12)});
}

void AddPicture(SceneKit& kit, Print print, const Vector3d& centre, double yaw_rad,
                const Eigen::Vector2d& size_m) {
  kit.Add("", Upright(centre, yaw_rad),
          {kit.Box({0.5 * size_m.x(), 0.5 * size_m.y(), 0.012}, {}, Black(kit)),
           kit.Sheet(size_m.x() - 0.02, size_m.y() - 0.02, Placed({0, 0, 0.0125}),
                     kit.PaintPrint(print, size_m.x() - 0.02, size_m.y() - 0.02))});
}

void AddCartons(SceneKit& kit, const Vector3d& position) {
  const TexturePtr card = kit.Paint(Material::kCardboard, {110, 150, 185});
  const double low = kit.Uniform(0.14, 0.2);
  kit.Add("", Placed(position, kit.Uniform(-0.5, 0.5)),
          {kit.Box({0.24, 0.2, low}, Placed({0, 0, low}), card),
           kit.Box({0.17, 0.15, 0.12}, Placed({0.03, 0.02, 2 * low + 0.12}, kit.Uniform(-0.5, 0.5)),
                   card)});
}

}  // namespace ofm
