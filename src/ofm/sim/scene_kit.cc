#include "ofm/sim/scene_kit.h"

#include <utility>

namespace ofm {

using Eigen::Vector3d;

RigidTransform Placed(const Vector3d& position, double yaw_rad) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ())), position};
}

RigidTransform Upright(const Vector3d& centre, double yaw_rad) {
  const Vector3d normal(std::cos(yaw_rad), std::sin(yaw_rad), 0);
  const Vector3d up = Vector3d::UnitZ();
  Eigen::Matrix3d axes;
  axes << up.cross(normal), up, normal;
  return {axes, centre};
}

TexturePtr SceneKit::Paint(Material material, const cv::Scalar& bgr) {
  TexturePtr& texture = painted_[{material, bgr[0], bgr[1], bgr[2]}];
  if (texture == nullptr) {
    // By what it is, not by when it is first asked for.
    const auto tone = static_cast<std::uint64_t>(bgr[0] * 65536 + bgr[1] * 256 + bgr[2]);
    const std::uint64_t kind = static_cast<std::uint64_t>(material) + 1;
    texture =
        std::make_shared<Texture>(MakeMaterial(material, bgr, (seed_ << 32) + (kind << 24) + tone));
  }
  return texture;
}

TexturePtr SceneKit::PaintPrint(Print print, double width_m, double height_m) {
  return std::make_shared<Texture>(MakePrint(print, width_m, height_m, (seed_ << 20) + ++prints_));
}

Part SceneKit::MakePart(Shape shape, const Vector3d& half_extent_m,
                        const RigidTransform& body_from_part, TexturePtr texture) {
  Part part{shape, half_extent_m, body_from_part, std::move(texture), {}};
  part.texture_offset_m.x() = Uniform(0, 2);
  part.texture_offset_m.y() = Uniform(0, 2);
  return part;
}

Part SceneKit::Box(const Vector3d& half_extent_m, const RigidTransform& body_from_part,
                   TexturePtr texture) {
  return MakePart(Shape::kBox, half_extent_m, body_from_part, std::move(texture));
}

Part SceneKit::Cylinder(const Vector3d& half_extent_m, const RigidTransform& body_from_part,
                        TexturePtr texture, double taper) {
  Part part = MakePart(Shape::kCylinder, half_extent_m, body_from_part, std::move(texture));
  part.taper = taper;
  return part;
}

Part SceneKit::Ellipsoid(const Vector3d& half_extent_m, const RigidTransform& body_from_part,
                         TexturePtr texture) {
  return MakePart(Shape::kEllipsoid, half_extent_m, body_from_part, std::move(texture));
}

Part SceneKit::Sheet(double width_m, double height_m, const RigidTransform& body_from_part,
                     TexturePtr texture) {
  return {Shape::kRectangle,
          {0.5 * width_m, 0.5 * height_m, 0},
          body_from_part,
          std::move(texture),
          {}};
}

void SceneKit::Add(std::string class_name, const RigidTransform& world_from_body,
                   std::vector<Part> parts) {
  Add(Body{{}, std::move(class_name), StaticMotion{world_from_body}, std::move(parts)});
}

void SceneKit::AddLamp(const Lamp& lamp) {
  lighting_.lamps.push_back(lamp);
  const auto& half = lamp.half_extent_m;
  Part panel = Box({half.x(), half.y(), 0.02}, {}, Paint(Material::kPlain, {235, 245, 250}));
  panel.glow = 1;
  Add("", Placed(lamp.centre_in_world + Vector3d(0, 0, 0.02)), {panel});
}

}  // namespace ofm
