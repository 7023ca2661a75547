#include "ofm/sim/room.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "ofm/base/random.h"
#include "ofm/sim/person.h"

namespace ofm {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

/// Builds the bodies of one room; every draw comes from its engine.
class RoomBuilder {
 public:
  RoomBuilder(const RoomOptions& options, std::uint64_t seed)
      : options_(options), seed_(seed), engine_(MakeRandomEngine(seed, 0)) {}

  Scene Build() {
    AddShell();
    AddDesk();
    AddShelves();
    AddChair();
    AddPictures();
    AddFloorClutter();
    AddMovers();
    return Scene(std::move(bodies_), viewpoint_);
  }

 private:
  double Uniform(double low, double high) { return low + (high - low) * UniformReal(engine_); }

  /// A new texture; `metres_per_texel` sets how fine its corners are.
  std::shared_ptr<const Texture> Paint(double metres_per_texel, int size_px) {
    TextureOptions texture;
    texture.metres_per_texel = metres_per_texel;
    texture.size_px = size_px;
    return std::make_shared<Texture>(texture, seed_ * 1000 + ++textures_);
  }

  /// A part that shows a piece of `texture` of its own.
  Part MakePart(Shape shape, const Vector3d& half_extent_m, const RigidTransform& body_from_part,
                std::shared_ptr<const Texture> texture) {
    const double u = Uniform(0, 1);
    const double v = Uniform(0, 1);
    return {shape, half_extent_m, body_from_part, std::move(texture), {}, {u, v}};
  }

  Part MakeBox(const Vector3d& half_extent_m, const RigidTransform& body_from_part,
               std::shared_ptr<const Texture> texture) {
    return MakePart(Shape::kBox, half_extent_m, body_from_part, std::move(texture));
  }

  static RigidTransform Placed(const Vector3d& position, double yaw_rad = 0) {
    return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ())), position};
  }

  void AddStatic(std::string class_name, const RigidTransform& world_from_body,
                 std::vector<Part> parts) {
    bodies_.push_back({{}, std::move(class_name), StaticMotion{world_from_body}, std::move(parts)});
  }

  void AddWall(const Vector3d& centre, const Vector3d& axis_u, const Vector3d& axis_v,
               double width_m, double height_m) {
    Eigen::Matrix3d axes;
    axes << axis_u, axis_v, axis_u.cross(axis_v);
    const Part wall = MakePart(Shape::kRectangle, {0.5 * width_m, 0.5 * height_m, 0}, {},
                               Paint(kWallTexel_m, kWallTexture_px));
    AddStatic("", {axes, centre}, {wall});
  }

  void AddShell() {
    const double w = options_.width_m, d = options_.depth_m, h = options_.height_m;
    const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
    AddWall(Vector3d::Zero(), x, y, w, d);
    AddWall(h * z, x, y, w, d);
    AddWall({0, 0.5 * d, 0.5 * h}, x, z, w, h);
    AddWall({0, -0.5 * d, 0.5 * h}, x, z, w, h);
    AddWall({0.5 * w, 0, 0.5 * h}, y, z, d, h);
    AddWall({-0.5 * w, 0, 0.5 * h}, y, z, d, h);
  }

  void AddDesk() {
    constexpr double kTop_m = 0.74;
    const auto wood = Paint(3e-3, 512);
    const auto things = Paint(1.5e-3, 512);
    const double y = 0.5 * options_.depth_m - 0.5;
    const RigidTransform world_from_desk = Placed({Uniform(-0.2, 0.2), y, 0});
    std::vector<Part> desk = {MakeBox({0.85, 0.38, 0.02}, Placed({0, 0, kTop_m - 0.02}), wood)};
    for (const double side : {-0.8, 0.8}) {
      desk.push_back(MakeBox({0.02, 0.35, 0.35}, Placed({side, 0, 0.35}), wood));
    }
    AddStatic("dining table", world_from_desk, desk);
    const auto put = [&](const char* name, const Vector3d& half, double x, double dy, double yaw) {
      AddStatic(name, world_from_desk * Placed({x, dy, kTop_m + half.z()}, yaw),
                {MakeBox(half, {}, things)});
    };
    put("tv", {0.27, 0.03, 0.19}, Uniform(-0.2, 0.1), 0.15, Uniform(-0.2, 0.2));
    put("keyboard", {0.2, 0.07, 0.012}, Uniform(-0.1, 0.1), -0.2, Uniform(-0.1, 0.1));
    put("book", {0.1, 0.14, 0.03}, Uniform(-0.7, -0.55), -0.1, Uniform(-0.6, 0.6));
    put("book", {0.13, 0.1, 0.05}, Uniform(0.45, 0.65), -0.15, Uniform(-0.6, 0.6));
    put("", {0.1, 0.1, 0.16}, Uniform(0.5, 0.7), 0.2, Uniform(-0.6, 0.6));
    put("", {0.08, 0.12, 0.11}, Uniform(-0.65, -0.5), 0.2, Uniform(-0.6, 0.6));
    AddStatic("sports ball", world_from_desk * Placed({0.33, -0.1, kTop_m + 0.09}),
              {MakePart(Shape::kEllipsoid, Vector3d::Constant(0.09), {}, things)});
  }

  void AddShelves() {
    const auto wood = Paint(3e-3, 512);
    const auto things = Paint(1.5e-3, 512);
    for (const double side : {-1.0, 1.0}) {
      const double x = side * (0.5 * options_.width_m - 0.2);
      const RigidTransform world_from_shelf = Placed({x, Uniform(-0.3, 0.6), 0});
      std::vector<Part> boards;
      for (const double z : {0.1, 0.7, 1.3, 1.9}) {
        boards.push_back(MakeBox({0.17, 0.5, 0.015}, Placed({0, 0, z}), wood));
      }
      AddStatic("", world_from_shelf, boards);
      for (const double z : {0.1, 0.7, 1.3}) {
        const Vector3d half(0.12, Uniform(0.1, 0.3), Uniform(0.1, 0.2));
        const Vector3d place(0, Uniform(-0.2, 0.2), z + 0.015 + half.z());
        AddStatic("book", world_from_shelf * Placed(place), {MakeBox(half, {}, things)});
      }
    }
  }

  void AddChair() {
    const auto cloth = Paint(2e-3, 512);
    const double yaw = Uniform(-0.5, 0.5);
    AddStatic("chair", Placed({Uniform(0.9, 1.3), 0.5 * options_.depth_m - 1.1, 0}, yaw),
              {MakeBox({0.22, 0.22, 0.03}, Placed({0, 0, 0.45}), cloth),
               MakeBox({0.22, 0.025, 0.24}, Placed({0, -0.2, 0.72}), cloth),
               MakeBox({0.03, 0.03, 0.21}, Placed({0, 0, 0.21}), cloth)});
  }

  void AddPictures() {
    const auto print = Paint(2e-3, 512);
    const double y = 0.5 * options_.depth_m - 0.02;
    for (const double side : {-1.0, 1.0}) {
      for (const double x : {-1.6, 0.1, 1.7}) {
        AddStatic("", Placed({x + Uniform(-0.2, 0.2), side * y, Uniform(1.5, 1.8)}),
                  {MakeBox({Uniform(0.2, 0.4), 0.015, Uniform(0.15, 0.3)}, {}, print)});
      }
    }
  }

  void AddFloorClutter() {
    const auto card = Paint(2e-3, 512);
    const double x = 0.5 * options_.width_m - 0.6;
    const double y = 0.5 * options_.depth_m - 0.5;
    for (const Vector3d& corner : {Vector3d(x, y, 0), Vector3d(-x, y, 0), Vector3d(-x, -y, 0),
                                   Vector3d(x, -y, 0), Vector3d(0, -y, 0)}) {
      const Vector3d half(Uniform(0.15, 0.3), Uniform(0.15, 0.3), Uniform(0.15, 0.45));
      const Vector3d place = corner + Vector3d(Uniform(-0.1, 0.1), Uniform(-0.1, 0.1), half.z());
      AddStatic("", Placed(place, Uniform(0, kPi)), {MakeBox(half, {}, card)});
    }
  }

  /// The way of the `index`-th mover: across the view, each a bit farther than the one before.
  SweepMotion SweepAcross(int index, double base_z_m) {
    constexpr double kSpacing_m = 0.4;
    SweepMotion motion;
    motion.centre_in_world = viewpoint_.eye_in_world;
    motion.centre_in_world.x() += Uniform(-0.15, 0.15);
    motion.centre_in_world.y() += options_.mover_distance_m + kSpacing_m * index;
    motion.centre_in_world.z() = base_z_m;
    motion.amplitude_m = {Uniform(0.6, 0.9), Uniform(-0.15, 0.15), 0};
    motion.period_s = options_.mover_period_s * Uniform(0.7, 1);
    motion.phase_rad = Uniform(0, 2 * kPi);
    return motion;
  }

  void AddMovers() {
    for (int k = 0; k < options_.people; ++k) {
      const PersonLook look{Uniform(1.6, 1.9), Paint(1.5e-3, 512), Paint(1.5e-3, 512),
                            Uniform(0, 2 * kPi)};
      bodies_.push_back(MakePerson(SweepAcross(k, 0), look));
    }
    for (int k = 0; k < options_.carried_boxes; ++k) {
      const Vector3d half(Uniform(0.12, 0.2), Uniform(0.12, 0.2), Uniform(0.12, 0.2));
      const Motion motion = SweepAcross(options_.people + k, Uniform(0.9, 1.2));
      bodies_.push_back({{}, "box", motion, {MakeBox(half, {}, Paint(1.5e-3, 512))}});
    }
  }

  static constexpr double kWallTexel_m = 6e-3;
  static constexpr int kWallTexture_px = 1024;

  RoomOptions options_;
  std::uint64_t seed_;
  RandomEngine engine_;
  std::uint64_t textures_ = 0;
  Viewpoint viewpoint_{{0, -0.8, 1.35}, {0, 2.0, 0.95}};
  std::vector<Body> bodies_;
};

}  // namespace

Scene MakeRoom(const RoomOptions& options, std::uint64_t seed) {
  return RoomBuilder(options, seed).Build();
}

}  // namespace ofm
