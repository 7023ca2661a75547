// Small worlds for the tests of this module.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "ofm/sim/scene.h"

namespace ofm {

inline std::shared_ptr<const Texture> MakeTestTexture(std::uint64_t seed) {
  TextureOptions options;
  options.size_px = 256;
  options.metres_per_texel = 0.01;
  return std::make_shared<Texture>(options, seed);
}

inline RigidTransform Shift(double x, double y, double z) {
  return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, y, z)};
}

inline Body MakeTestBody(std::string class_name, const Motion& motion, Shape shape,
                         const Eigen::Vector3d& half_extent_m) {
  return {{},
          std::move(class_name),
          motion,
          {{shape, half_extent_m, {}, MakeTestTexture(half_extent_m.x() > 1 ? 1 : 2), {}, {0, 0}}}};
}

/// A wall at z = 4 m that more than fills the view of a camera at the origin with the world's axes.
inline Body MakeTestWall() {
  return MakeTestBody("", StaticMotion{Shift(0, 0, 4)}, Shape::kRectangle, {10, 10, 0});
}

}  // namespace ofm
