// What builders of worlds share: draws, textures, parts, and the list of bodies.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "ofm/base/random.h"
#include "ofm/sim/material.h"
#include "ofm/sim/print.h"
#include "ofm/sim/scene.h"

namespace ofm {

using TexturePtr = std::shared_ptr<const Texture>;

/// A shift and a turn about the vertical.
RigidTransform Placed(const Eigen::Vector3d& position, double yaw_rad = 0);
/// A rectangle's place: its u to the right and v up for who looks at it along -normal; `yaw_rad` is
/// the normal's about z, from the x axis.
RigidTransform Upright(const Eigen::Vector3d& centre, double yaw_rad);

/// Collects the bodies of a world. The same calls with the same seed give the same world.
class SceneKit {
 public:
  explicit SceneKit(std::uint64_t seed) : seed_(seed), engine_(MakeRandomEngine(seed, 1)) {}

  /// Draws come from another stream from now on, so that what is added later does not depend on how
  /// much was drawn before.
  void BeginStream(std::uint64_t stream) {
    engine_ = MakeRandomEngine(seed_, stream);
    prints_ = stream * 1000;
  }

  double Uniform(double low, double high) { return low + (high - low) * UniformReal(engine_); }
  int Index(int count) {
    return static_cast<int>(UniformIndex(engine_, static_cast<std::uint32_t>(count)));
  }

  /// A material's texture, made once for each colour.
  TexturePtr Paint(Material material, const cv::Scalar& bgr = cv::Scalar::all(128));
  /// A new image.
  TexturePtr PaintPrint(Print print, double width_m, double height_m);

  /// Parts that show pieces of `texture` of their own.
  Part Box(const Eigen::Vector3d& half_extent_m, const RigidTransform& body_from_part,
           TexturePtr texture);
  Part Cylinder(const Eigen::Vector3d& half_extent_m, const RigidTransform& body_from_part,
                TexturePtr texture, double taper = 0);
  Part Ellipsoid(const Eigen::Vector3d& half_extent_m, const RigidTransform& body_from_part,
                 TexturePtr texture);
  /// A rectangle that shows the texture from its middle on.
  Part Sheet(double width_m, double height_m, const RigidTransform& body_from_part,
             TexturePtr texture);

  /// A body that stands still.
  void Add(std::string class_name, const RigidTransform& world_from_body, std::vector<Part> parts);
  void Add(Body body) { bodies_.push_back(std::move(body)); }
  /// A lamp, and its panel that is seen.
  void AddLamp(const Lamp& lamp);

  Scene Build(const Viewpoint& viewpoint) const { return {bodies_, viewpoint, lighting_}; }

 private:
  Part MakePart(Shape shape, const Eigen::Vector3d& half_extent_m,
                const RigidTransform& body_from_part, TexturePtr texture);

  std::uint64_t seed_;
  RandomEngine engine_;
  std::uint64_t prints_ = 0;
  std::map<std::tuple<Material, double, double, double>, TexturePtr> painted_;
  std::vector<Body> bodies_;
  Lighting lighting_;
};

}  // namespace ofm
