// Asks whether something stands between two points.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "ofm/sim/scene.h"

namespace ofm {

/// The solids that stand still, as boxes and ellipsoids; cylinders count as boxes.
class Occluders {
 public:
  explicit Occluders(const std::vector<Body>& bodies);

  /// Indices of those that meet `box`.
  std::vector<int> Near(const Eigen::AlignedBox3f& box) const;

  /// Share of the ray's length at which it first meets one of `candidates`; 1 where it meets none.
  float FirstHit(const Eigen::Vector3f& origin, const Eigen::Vector3f& ray,
                 const std::vector<int>& candidates) const;
  /// True where it meets one at all.
  bool IsHidden(const Eigen::Vector3f& origin, const Eigen::Vector3f& ray,
                const std::vector<int>& candidates) const;

 private:
  struct Solid {
    Eigen::AlignedBox3f bounds;
    Eigen::Matrix3f unit_from_world;  ///< to the cube or sphere of half size 1
    Eigen::Vector3f offset;
    bool is_round;
  };

  static float Enter(const Solid& solid, const Eigen::Vector3f& origin, const Eigen::Vector3f& ray);

  std::vector<Solid> solids_;
};

}  // namespace ofm
