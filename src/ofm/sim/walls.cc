#include "ofm/sim/walls.h"

namespace ofm {
namespace {

using Eigen::Vector3d;

constexpr double kHalfThickness_m = 0.05;

/// Adds pieces of one wall, in its own frame: x along it, z up.
class WallBuilder {
 public:
  WallBuilder(SceneKit& kit, const WallPlan& plan) : kit_(kit), plan_(plan) {
    const Eigen::Vector2d along = plan.to - plan.from;
    length_m_ = along.norm();
    world_from_wall_ = Placed({plan.from.x(), plan.from.y(), 0}, std::atan2(along.y(), along.x()));
  }

  void Build() {
    double at = 0;
    for (const Opening& opening : plan_.openings) {
      AddPiece(at, opening.from_m, 0, plan_.height_m);
      AddSkirting(at, opening.from_m);
      AddPiece(opening.from_m, opening.to_m, opening.top_m, plan_.height_m);
      AddPiece(opening.from_m, opening.to_m, 0, opening.bottom_m);
      AddFrame(opening);
      at = opening.to_m;
    }
    AddPiece(at, length_m_, 0, plan_.height_m);
    AddSkirting(at, length_m_);
    kit_.Add("", world_from_wall_, parts_);
  }

 private:
  void AddBox(double from_m, double to_m, double bottom_m, double top_m, double half_m,
              const TexturePtr& texture) {
    if (to_m - from_m < 1e-3 || top_m - bottom_m < 1e-3) return;
    parts_.push_back(kit_.Box({0.5 * (to_m - from_m), half_m, 0.5 * (top_m - bottom_m)},
                              Placed({0.5 * (from_m + to_m), 0, 0.5 * (bottom_m + top_m)}),
                              texture));
  }
  void AddPiece(double from_m, double to_m, double bottom_m, double top_m) {
    AddBox(from_m, to_m, bottom_m, top_m, kHalfThickness_m, plan_.texture);
  }
  void AddSkirting(double from_m, double to_m) {
    AddBox(from_m, to_m, 0, 0.09, kHalfThickness_m + 0.012,
           kit_.Paint(Material::kWood, {70, 100, 135}));
  }
  void AddFrame(const Opening& o) {
    constexpr double kFrame_m = 0.06;
    const TexturePtr paint = kit_.Paint(Material::kPlain, {205, 210, 215});
    const double half = kHalfThickness_m + 0.02;
    AddBox(o.from_m - kFrame_m, o.from_m, o.bottom_m, o.top_m + kFrame_m, half, paint);
    AddBox(o.to_m, o.to_m + kFrame_m, o.bottom_m, o.top_m + kFrame_m, half, paint);
    AddBox(o.from_m, o.to_m, o.top_m, o.top_m + kFrame_m, half, paint);
  }

  SceneKit& kit_;
  const WallPlan& plan_;
  double length_m_;
  RigidTransform world_from_wall_;
  std::vector<Part> parts_;
};

RigidTransform SlabPlace(const Slab& slab, const Vector3d& axis_u, const Vector3d& axis_v) {
  Eigen::Matrix3d axes;
  axes << axis_u, axis_v, axis_u.cross(axis_v);
  const Eigen::Vector2d middle = 0.5 * (slab.from + slab.to);
  return {axes, Vector3d(middle.x(), middle.y(), slab.z_m)};
}

}  // namespace

void AddWall(SceneKit& kit, const WallPlan& plan) { WallBuilder(kit, plan).Build(); }

void AddFloor(SceneKit& kit, const Slab& slab) {
  const Eigen::Vector2d size = slab.to - slab.from;
  kit.Add("", SlabPlace(slab, Vector3d::UnitX(), Vector3d::UnitY()),
          {kit.Sheet(size.x(), size.y(), {}, slab.texture)});
}

void AddCeiling(SceneKit& kit, const Slab& slab) {
  const Eigen::Vector2d size = slab.to - slab.from;
  kit.Add("", SlabPlace(slab, Vector3d::UnitY(), Vector3d::UnitX()),
          {kit.Sheet(size.y(), size.x(), {}, slab.texture)});
}

}  // namespace ofm
