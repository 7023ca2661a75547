#include "ofm/sim/scene.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "ofm/base/check.h"
#include "ofm/sim/light_baker.h"

namespace ofm {

RigidTransform WorldFromPart(const Body& body, const Part& part, double time_s) {
  const RigidTransform world_from_body = WorldFromBody(body.motion, time_s);
  const Swing& swing = part.swing;
  if (swing.amplitude_rad == 0) return world_from_body * part.body_from_part;
  const double phase = 2 * std::numbers::pi * time_s / swing.period_s + swing.phase_rad;
  const Eigen::Quaterniond rotation =
      ExpSo3(swing.axis_in_body.normalized() * (swing.amplitude_rad * std::sin(phase)));
  const RigidTransform about_pivot(rotation, swing.pivot_in_body - rotation * swing.pivot_in_body);
  return world_from_body * about_pivot * part.body_from_part;
}

std::vector<RigidTransform> WorldFromParts(const Body& body, double time_s) {
  std::vector<RigidTransform> places;
  if (body.body_from_parts) {
    const RigidTransform world_from_body = WorldFromBody(body.motion, time_s);
    places = body.body_from_parts(time_s);
    OFM_CHECK(places.size() == body.parts.size());
    for (RigidTransform& place : places) place = world_from_body * place;
  } else {
    for (const Part& part : body.parts) places.push_back(WorldFromPart(body, part, time_s));
  }
  return places;
}

Scene::Scene(std::vector<Body> bodies, const Viewpoint& viewpoint, const Lighting& lighting)
    : Scene(std::move(bodies), viewpoint) {
  lighting_ = lighting;
  if (!lighting.lamps.empty()) baked_ = BakeLight(bodies_, lighting);
}

Scene::Scene(std::vector<Body> bodies, const Viewpoint& viewpoint)
    : bodies_(std::move(bodies)), viewpoint_(viewpoint) {
  const auto number = [this](Body& body) {
    body.id = InstanceId(static_cast<std::uint32_t>(class_names_.size()));
    class_names_.push_back(body.class_name);
  };
  for (Body& body : bodies_) {
    for (const Part& part : body.parts) OFM_CHECK(part.texture != nullptr);
    if (IsMoving(body.motion)) number(body);
  }
  mover_count_ = static_cast<std::uint32_t>(class_names_.size()) - 1;
  for (Body& body : bodies_) {
    if (IsMoving(body.motion)) continue;
    if (body.class_name.empty()) {
      body.id = InstanceId(0);
    } else {
      number(body);
    }
  }
  OFM_CHECK(class_names_.size() <= 256);
}

}  // namespace ofm
