// Surfaces in the camera's frame, ready to be met by the rays of pixels.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "ofm/sim/scene.h"

namespace ofm {

/// A rectangle on the plane z = 1 of the camera: normalised image coordinates.
struct ImageBounds {
  float min_x = std::numeric_limits<float>::infinity();
  float min_y = std::numeric_limits<float>::infinity();
  float max_x = -std::numeric_limits<float>::infinity();
  float max_y = -std::numeric_limits<float>::infinity();
};

/// A rectangle, an ellipsoid or a cylinder as one camera sees it. A pixel's ray is (x, y, 1), so
/// the distance along it is the depth z.
struct Surface {
  enum class Kind { kPlane, kEllipsoid, kCylinder };
  Kind kind = Kind::kPlane;
  ImageBounds bounds;

  // Plane: 1/z = inverse_depth . ray, u = z * axis_u . ray - offset_u, and v likewise.
  Eigen::Vector3f inverse_depth, axis_u, axis_v;
  float offset_u = 0, offset_v = 0;  ///< [m]
  float half_u = 0, half_v = 0;      ///< [m]
  Eigen::Vector3f normal_in_camera;  ///< towards the camera

  // Ellipsoid: the affine map to the unit sphere. Cylinder: to the one of radius 1 + taper z about
  // the z axis, for z from -1 to 1.
  Eigen::Matrix3f sphere_from_camera;
  Eigen::Vector3f camera_in_sphere;
  Eigen::Vector3f radii_m;
  float taper = 0;

  const Texture* texture = nullptr;
  Eigen::Vector2f texture_offset_m = Eigen::Vector2f::Zero();
  const LightMap* light_map = nullptr;  ///< what falls on a plane; otherwise the next three hold
  Eigen::Vector3f light_in_camera;      ///< direction that light comes from
  float ambient = 0.55F, diffuse = 0.45F;
  float glow = 0;
  std::uint8_t instance = 0;
  int part = 0;  ///< counts the parts of all bodies in their order
};

/// What of `scene` can be in view at `time_s`. Refers to the scene's textures and light maps.
std::vector<Surface> MakeSurfaces(const Scene& scene, double time_s,
                                  const RigidTransform& camera_from_world);

/// Rays side by side with what they met so far.
struct RaySpan {
  const float* x;  ///< the rays are (x, y, 1)
  const float* y;
  float* depth_m;  ///< of the nearest surface so far
  int* surface;    ///< its index
  int count;
};

/// Enters `surface`, the `index`-th, wherever it is nearer than what the rays met before.
void IntersectSpan(const Surface& surface, int index, const RaySpan& span);

/// Colour (BGR, 0 to 255) of `surface` where the ray (x, y, 1) meets it at `depth_m`: the texture
/// averaged over a pixel that is `pixel_angle` [rad] wide, with Lambert shading.
Eigen::Array3f ShadeSurface(const Surface& surface, const Eigen::Vector2f& ray_xy, float depth_m,
                            float pixel_angle);

}  // namespace ofm
