#include "ofm/sim/person.h"

#include <numbers>
#include <utility>

namespace ofm {
namespace {

using Eigen::Vector3d;

/// Proportions of a person who is 1.75 m tall.
constexpr double kReferenceHeight_m = 1.75;
constexpr double kStridePeriod_s = 1.1;

/// A part at `centre`, upright.
Part Upright(Shape shape, const Vector3d& half_extent_m, const Vector3d& centre,
             std::shared_ptr<const Texture> texture) {
  return {shape, half_extent_m, {Eigen::Quaterniond::Identity(), centre}, std::move(texture), {}};
}

/// Hangs `part` from its upper end.
Part Swinging(Part part, double amplitude_rad, double phase_rad) {
  part.swing.pivot_in_body =
      part.body_from_part.translation() + Vector3d(0, 0, part.half_extent_m.z());
  part.swing.axis_in_body = Vector3d::UnitY();
  part.swing.amplitude_rad = amplitude_rad;
  part.swing.period_s = kStridePeriod_s;
  part.swing.phase_rad = phase_rad;
  return part;
}

}  // namespace

Body MakePerson(const Motion& motion, const PersonLook& look) {
  constexpr double kLegSwing_rad = 0.4;
  constexpr double kArmSwing_rad = 0.5;
  const double s = look.height_m / kReferenceHeight_m;
  Body person{{}, "person", motion, {}};
  person.parts.push_back(Upright(Shape::kEllipsoid, s * Vector3d(0.15, 0.24, 0.36),
                                 s * Vector3d(0, 0, 1.12), look.upper));
  person.parts.push_back(Upright(Shape::kEllipsoid, s * Vector3d(0.1, 0.085, 0.125),
                                 s * Vector3d(0.02, 0, 1.625), look.lower));
  for (const double side : {-1.0, 1.0}) {
    const double phase = look.stride_phase_rad + (side > 0 ? std::numbers::pi : 0);
    const Part leg = Upright(Shape::kBox, s * Vector3d(0.075, 0.075, 0.43),
                             s * Vector3d(0, side * 0.1, 0.43), look.lower);
    const Part arm = Upright(Shape::kEllipsoid, s * Vector3d(0.055, 0.055, 0.34),
                             s * Vector3d(0, side * 0.27, 1.08), look.upper);
    person.parts.push_back(Swinging(leg, kLegSwing_rad, phase));
    person.parts.push_back(Swinging(arm, kArmSwing_rad, phase + std::numbers::pi));
  }
  return person;
}

}  // namespace ofm
