// The simulated world: bodies made of textured rectangles, boxes and ellipsoids.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ofm/base/ids.h"
#include "ofm/geometry/rigid_transform.h"
#include "ofm/sim/light_map.h"
#include "ofm/sim/motion.h"
#include "ofm/sim/texture.h"

namespace ofm {

enum class Shape {
  kRectangle,  ///< in the part's x-y plane, seen from both sides; half_extent_m.z() is not used
  kBox,
  kEllipsoid,
  kCylinder,  ///< closed, along the part's z axis; x and y are the radii at half its height
};

/// A rotation to and fro about an axis through `pivot`: a limb.
struct Swing {
  Eigen::Vector3d pivot_in_body = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_in_body = Eigen::Vector3d::UnitY();
  double amplitude_rad = 0;
  double period_s = 1;
  double phase_rad = 0;
};

/// One solid of a body.
struct Part {
  Shape shape = Shape::kBox;
  Eigen::Vector3d half_extent_m = Eigen::Vector3d::Constant(0.5);
  RigidTransform body_from_part;  ///< at rest; the part's centre is its origin
  std::shared_ptr<const Texture> texture;
  Swing swing;
  /// Where on the texture the part begins, so that parts may share one and not look alike [m].
  Eigen::Vector2d texture_offset_m = Eigen::Vector2d::Zero();
  /// A cylinder's radii at its upper end are (1 + taper) times those at half its height, at its
  /// lower end (1 - taper) times; within -1 and 1.
  double taper = 0;
  double glow = 0;  ///< what it shines by itself, as a share of its texture's colour
};

/// Something that moves as one, its swinging limbs apart.
struct Body {
  InstanceId id;           ///< given by Scene
  std::string class_name;  ///< COCO name where there is one; empty for walls and the like
  Motion motion;
  std::vector<Part> parts;
  /// body_from_part of each part in their order, in place of the parts' own places and swings;
  /// empty where those hold. A function without a state.
  std::function<std::vector<RigidTransform>(double time_s)> body_from_parts = {};
};

/// Where `part` of `body` is at `time_s`.
RigidTransform WorldFromPart(const Body& body, const Part& part, double time_s);

/// Where each part of `body` is at `time_s`, whatever moves them.
std::vector<RigidTransform> WorldFromParts(const Body& body, double time_s);

/// A place to look from: the room's best view.
struct Viewpoint {
  Eigen::Vector3d eye_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_in_world = Eigen::Vector3d::UnitY();
  /// A closed way through the world that is free to go, (x, y) of its corners; may be empty.
  std::vector<Eigen::Vector2d> tour_in_world = {};
};

/// An immutable world, z up, in metres.
class Scene {
 public:
  /// Numbers the bodies: the movers from 1 in their order, then the static bodies that have a class
  /// name; what has none is background and gets 0. At most 255 numbers.
  Scene(std::vector<Body> bodies, const Viewpoint& viewpoint);
  /// The same, lit by lamps instead of one far light.
  Scene(std::vector<Body> bodies, const Viewpoint& viewpoint, const Lighting& lighting);

  const std::vector<Body>& bodies() const { return bodies_; }
  const Viewpoint& viewpoint() const { return viewpoint_; }
  /// Movers have the ids 1 to mover_count().
  std::uint32_t mover_count() const { return mover_count_; }
  /// Class names by InstanceId; "" for 0.
  const std::vector<std::string>& class_names() const { return class_names_; }
  /// Towards the light, a unit vector; where there are no lamps.
  const Eigen::Vector3d& light_in_world() const { return light_in_world_; }
  /// Empty of lamps where the far light holds.
  const Lighting& lighting() const { return lighting_; }
  /// What falls on the faces of parts that stand still; empty where the far light holds.
  const BakedLight& baked() const { return baked_; }

 private:
  std::vector<Body> bodies_;
  Viewpoint viewpoint_;
  std::uint32_t mover_count_ = 0;
  std::vector<std::string> class_names_ = {""};
  Lighting lighting_;
  BakedLight baked_;
  Eigen::Vector3d light_in_world_ = Eigen::Vector3d(0.35, -0.5, 0.8).normalized();
};

}  // namespace ofm
