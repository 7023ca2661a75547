#include "ofm/sim/occluders.h"

#include <algorithm>
#include <cmath>

namespace ofm {
namespace {

/// Where the ray enters the cube of half size 1; 1 where it does not within its length.
float EnterCube(const Eigen::Vector3f& origin, const Eigen::Vector3f& ray) {
  float enter = 0;
  float leave = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const float inverse = 1 / ray[axis];
    const float a = (-1 - origin[axis]) * inverse;
    const float b = (1 - origin[axis]) * inverse;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave ? enter : 1;
}

/// The same for the unit sphere.
float EnterSphere(const Eigen::Vector3f& origin, const Eigen::Vector3f& ray) {
  const float a = ray.squaredNorm();
  const float b = origin.dot(ray);
  const float discriminant = b * b - a * (origin.squaredNorm() - 1);
  if (discriminant <= 0) return 1;
  const float enter = (-b - std::sqrt(discriminant)) / a;
  return enter > 0 && enter < 1 ? enter : 1;
}

}  // namespace

Occluders::Occluders(const std::vector<Body>& bodies) {
  constexpr double kSheet_m = 1e-3;  // half the thickness of a rectangle
  for (const Body& body : bodies) {
    if (IsMoving(body.motion)) continue;
    const std::vector<RigidTransform> places = WorldFromParts(body, 0);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Part& part = body.parts[k];
      if (part.glow > 0) continue;  // lamps shade nothing
      const Eigen::Vector3d half = part.half_extent_m.cwiseMax(kSheet_m);
      const Eigen::Matrix3d axes = places[k].RotationMatrix();
      const Eigen::Vector3d reach = axes.cwiseAbs() * half;
      const Eigen::Matrix3d unit = half.cwiseInverse().asDiagonal() * axes.transpose();
      const Eigen::Vector3d centre = places[k].translation();
      solids_.push_back({{(centre - reach).cast<float>(), (centre + reach).cast<float>()},
                         unit.cast<float>(),
                         (-(unit * centre)).cast<float>(),
                         part.shape == Shape::kEllipsoid});
    }
  }
}

std::vector<int> Occluders::Near(const Eigen::AlignedBox3f& box) const {
  std::vector<int> near;
  for (int k = 0; k < static_cast<int>(solids_.size()); ++k) {
    if (solids_[k].bounds.intersects(box)) near.push_back(k);
  }
  return near;
}

float Occluders::Enter(const Solid& solid, const Eigen::Vector3f& origin,
                       const Eigen::Vector3f& ray) {
  const Eigen::Vector3f o = solid.unit_from_world * origin + solid.offset;
  const Eigen::Vector3f r = solid.unit_from_world * ray;
  return solid.is_round ? EnterSphere(o, r) : EnterCube(o, r);
}

float Occluders::FirstHit(const Eigen::Vector3f& origin, const Eigen::Vector3f& ray,
                          const std::vector<int>& candidates) const {
  float first = 1;
  for (const int k : candidates) first = std::min(first, Enter(solids_[k], origin, ray));
  return first;
}

bool Occluders::IsHidden(const Eigen::Vector3f& origin, const Eigen::Vector3f& ray,
                         const std::vector<int>& candidates) const {
  return std::any_of(candidates.begin(), candidates.end(),
                     [&](int k) { return Enter(solids_[k], origin, ray) < 1; });
}

}  // namespace ofm
