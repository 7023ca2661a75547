#include "ofm/sim/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "ofm/sim/light_baker.h"

namespace ofm {
namespace {

constexpr float kNearPlane_m = 0.05F;

/// Light about a part that has no light map.
struct LocalLight {
  Eigen::Vector3f from_in_camera;
  float ambient, diffuse;
};

/// What does not depend on the shape.
struct Look {
  const Texture* texture;
  Eigen::Vector2f texture_offset_m;
  std::uint8_t instance;
  int part;
  float glow;
  LocalLight light;
  const BakedLight* baked;

  /// Null where nothing was baked.
  const LightMap* FindLightMap(int face) const {
    const auto found = baked->find({part, face});
    return found == baked->end() ? nullptr : &found->second;
  }
};

/// Bounds of the projection of the convex hull of `corners`, as far as it is before the near plane.
ImageBounds BoundHull(std::span<const Eigen::Vector3d> corners) {
  ImageBounds bounds;
  const auto add = [&bounds](const Eigen::Vector3d& p) {
    const float x = static_cast<float>(p.x() / p.z());
    const float y = static_cast<float>(p.y() / p.z());
    bounds.min_x = std::min(bounds.min_x, x);
    bounds.max_x = std::max(bounds.max_x, x);
    bounds.min_y = std::min(bounds.min_y, y);
    bounds.max_y = std::max(bounds.max_y, y);
  };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i].z() >= kNearPlane_m) add(corners[i]);
    for (std::size_t k = 0; k < i; ++k) {
      const double a = corners[i].z() - kNearPlane_m;
      const double b = corners[k].z() - kNearPlane_m;
      if (a * b < 0) add((corners[k] * a - corners[i] * b) / (a - b));
    }
  }
  constexpr float kMargin = 1e-4F;
  bounds.min_x -= kMargin, bounds.min_y -= kMargin;
  bounds.max_x += kMargin, bounds.max_y += kMargin;
  return bounds;
}

Surface MakeSurface(Surface::Kind kind, const Look& look) {
  Surface surface;
  surface.kind = kind;
  surface.texture = look.texture;
  surface.texture_offset_m = look.texture_offset_m;
  surface.light_in_camera = look.light.from_in_camera;
  surface.ambient = look.light.ambient;
  surface.diffuse = look.light.diffuse;
  surface.glow = look.glow;
  surface.instance = look.instance;
  surface.part = look.part;
  return surface;
}

/// A rectangle with its centre and two edge directions (unit vectors) in the camera's frame.
struct Rectangle {
  Eigen::Vector3d centre, axis_u, axis_v;
  double half_u, half_v;
};

/// Appends `rectangle` unless it is seen edge-on or outside the view; each face shows another piece
/// of the texture.
void AddRectangle(const Rectangle& rectangle, const Look& look, int face,
                  std::vector<Surface>& surfaces) {
  constexpr double kEdgeOn_m = 1e-6;
  const auto& [centre, axis_u, axis_v, half_u, half_v] = rectangle;
  const Eigen::Vector3d normal = axis_u.cross(axis_v);
  const double distance = normal.dot(centre);
  if (std::abs(distance) < kEdgeOn_m) return;
  Surface surface = MakeSurface(Surface::Kind::kPlane, look);
  const std::array<Eigen::Vector3d, 4> corners = {
      centre + half_u * axis_u + half_v * axis_v, centre + half_u * axis_u - half_v * axis_v,
      centre - half_u * axis_u - half_v * axis_v, centre - half_u * axis_u + half_v * axis_v};
  surface.bounds = BoundHull(corners);
  if (!(surface.bounds.min_x <= surface.bounds.max_x)) return;
  surface.inverse_depth = (normal / distance).cast<float>();
  surface.axis_u = axis_u.cast<float>();
  surface.axis_v = axis_v.cast<float>();
  surface.offset_u = static_cast<float>(axis_u.dot(centre));
  surface.offset_v = static_cast<float>(axis_v.dot(centre));
  surface.half_u = static_cast<float>(half_u);
  surface.half_v = static_cast<float>(half_v);
  surface.normal_in_camera = (distance > 0 ? Eigen::Vector3d(-normal) : normal).cast<float>();
  constexpr double kShift_m = 0.37;
  surface.texture_offset_m.array() += static_cast<float>(kShift_m * face);
  surface.light_map = look.FindLightMap(face);
  surfaces.push_back(surface);
}

/// Appends the faces of a box that look towards the camera.
void AddBox(const Part& part, const RigidTransform& camera_from_part, const Look& look,
            std::vector<Surface>& surfaces) {
  const Eigen::Matrix3d axes = camera_from_part.RotationMatrix();
  const Eigen::Vector3d& half = part.half_extent_m;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      const Eigen::Vector3d normal = side * axes.col(axis);
      const Eigen::Vector3d centre = camera_from_part.translation() + half[axis] * normal;
      if (normal.dot(centre) >= 0) continue;
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      AddRectangle({centre, axes.col(u), axes.col(v), half[u], half[v]}, look,
                   2 * axis + (side + 1) / 2, surfaces);
    }
  }
}

/// An ellipsoid or a cylinder: what is bounded by its box.
void AddRound(const Part& part, const RigidTransform& camera_from_part, const Look& look,
              std::vector<Surface>& surfaces) {
  const Eigen::Matrix3d axes = camera_from_part.RotationMatrix();
  const Eigen::Vector3d& centre = camera_from_part.translation();
  const Eigen::Vector3d& half = part.half_extent_m;
  const bool is_cylinder = part.shape == Shape::kCylinder;
  Surface surface =
      MakeSurface(is_cylinder ? Surface::Kind::kCylinder : Surface::Kind::kEllipsoid, look);
  std::array<Eigen::Vector3d, 8> corners;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d sign((k & 1) ? 1 : -1, (k & 2) ? 1 : -1, (k & 4) ? 1 : -1);
    const double wider = is_cylinder ? 1 + part.taper * sign.z() : 1;
    corners[k] =
        centre + axes * half.cwiseProduct(sign.cwiseProduct(Eigen::Vector3d(wider, wider, 1)));
  }
  surface.bounds = BoundHull(corners);
  if (!(surface.bounds.min_x <= surface.bounds.max_x)) return;
  const Eigen::Matrix3d sphere_from_camera = half.cwiseInverse().asDiagonal() * axes.transpose();
  surface.sphere_from_camera = sphere_from_camera.cast<float>();
  surface.camera_in_sphere = (-(sphere_from_camera * centre)).cast<float>();
  surface.radii_m = half.cast<float>();
  surface.taper = static_cast<float>(part.taper);
  surfaces.push_back(surface);
}

void IntersectPlane(const Surface& s, int index, const RaySpan& span) {
  const float wx = s.inverse_depth.x(), wy = s.inverse_depth.y(), wz = s.inverse_depth.z();
  const float ux = s.axis_u.x(), uy = s.axis_u.y(), uz = s.axis_u.z();
  const float vx = s.axis_v.x(), vy = s.axis_v.y(), vz = s.axis_v.z();
  const float offset_u = s.offset_u, offset_v = s.offset_v;
  const float half_u = s.half_u, half_v = s.half_v;
  const float* __restrict x = span.x;
  const float* __restrict y = span.y;
  float* __restrict depth = span.depth_m;
  int* __restrict surface = span.surface;
  for (int i = 0; i < span.count; ++i) {
    const float z = 1 / (wx * x[i] + wy * y[i] + wz);
    const float u = z * (ux * x[i] + uy * y[i] + uz) - offset_u;
    const float v = z * (vx * x[i] + vy * y[i] + vz) - offset_v;
    // One condition without branches, so that the compiler makes vector code of it.
    const bool hit =
        (std::abs(u) <= half_u) & (std::abs(v) <= half_v) & (z > kNearPlane_m) & (z < depth[i]);
    depth[i] = hit ? z : depth[i];
    surface[i] = hit ? index : surface[i];
  }
}

void IntersectEllipsoid(const Surface& s, int index, const RaySpan& span) {
  const Eigen::Matrix3f& m = s.sphere_from_camera;
  const Eigen::Vector3f& o = s.camera_in_sphere;
  const float c = o.squaredNorm() - 1;
  for (int i = 0; i < span.count; ++i) {
    const float dx = m(0, 0) * span.x[i] + m(0, 1) * span.y[i] + m(0, 2);
    const float dy = m(1, 0) * span.x[i] + m(1, 1) * span.y[i] + m(1, 2);
    const float dz = m(2, 0) * span.x[i] + m(2, 1) * span.y[i] + m(2, 2);
    const float a = dx * dx + dy * dy + dz * dz;
    const float b = o.x() * dx + o.y() * dy + o.z() * dz;
    const float discriminant = b * b - a * c;
    const float z = (-b - std::sqrt(std::max(discriminant, 0.0F))) / a;
    const bool hit = (discriminant > 0) & (z > kNearPlane_m) & (z < span.depth_m[i]);
    span.depth_m[i] = hit ? z : span.depth_m[i];
    span.surface[i] = hit ? index : span.surface[i];
  }
}

/// The end of a cylinder that the camera sees: z along the ray; infinite where it is not met.
float MeetEnd(const Eigen::Vector3f& direction, const Eigen::Vector3f& origin, float taper) {
  const float end = origin.z() > 0 ? 1.0F : -1.0F;
  const float z = (end - origin.z()) / direction.z();
  const float x = origin.x() + z * direction.x();
  const float y = origin.y() + z * direction.y();
  const float radius = 1 + taper * end;
  const bool hit = std::abs(origin.z()) > 1 && x * x + y * y <= radius * radius && z > kNearPlane_m;
  return hit ? z : std::numeric_limits<float>::infinity();
}

/// The outside of a cylinder's mantle: z along the ray; infinite where it is not met.
float MeetMantle(const Eigen::Vector3f& d, const Eigen::Vector3f& o, float taper) {
  const float base = 1 + taper * o.z();
  const float slope = taper * d.z();
  const float a = d.x() * d.x() + d.y() * d.y() - slope * slope;
  const float b = o.x() * d.x() + o.y() * d.y() - base * slope;
  const float c = o.x() * o.x() + o.y() * o.y() - base * base;
  const float discriminant = b * b - a * c;
  if (discriminant <= 0) return std::numeric_limits<float>::infinity();
  const float z = (-b - std::sqrt(discriminant)) / a;
  const bool hit = std::abs(o.z() + z * d.z()) <= 1 && z > kNearPlane_m;
  return hit ? z : std::numeric_limits<float>::infinity();
}

void IntersectCylinder(const Surface& s, int index, const RaySpan& span) {
  for (int i = 0; i < span.count; ++i) {
    const Eigen::Vector3f direction =
        s.sphere_from_camera * Eigen::Vector3f(span.x[i], span.y[i], 1);
    const float z = std::min(MeetMantle(direction, s.camera_in_sphere, s.taper),
                             MeetEnd(direction, s.camera_in_sphere, s.taper));
    if (z < span.depth_m[i]) {
      span.depth_m[i] = z;
      span.surface[i] = index;
    }
  }
}

/// A point of a surface: its place on the texture and its normal.
struct SurfacePoint {
  float u_m, v_m;
  Eigen::Vector3f normal_in_camera;
};

/// `point` in the cylinder's own coordinates.
SurfacePoint LocateOnCylinder(const Surface& s, const Eigen::Vector3f& point, float longitude) {
  constexpr float kEnd = 0.9999F;
  Eigen::Vector3f normal(point.x(), point.y(), -s.taper * (1 + s.taper * point.z()));
  if (std::abs(point.z()) > kEnd) normal = {0, 0, point.z()};
  const bool at_end = std::abs(point.z()) > kEnd;
  return {at_end ? point.x() * s.radii_m.x() : longitude * 0.5F * (s.radii_m.x() + s.radii_m.y()),
          at_end ? point.y() * s.radii_m.y() : point.z() * s.radii_m.z(),
          (s.sphere_from_camera.transpose() * normal).normalized()};
}

SurfacePoint Locate(const Surface& s, const Eigen::Vector3f& point_in_camera) {
  if (s.kind == Surface::Kind::kPlane) {
    return {s.axis_u.dot(point_in_camera) - s.offset_u, s.axis_v.dot(point_in_camera) - s.offset_v,
            s.normal_in_camera};
  }
  const Eigen::Vector3f on_sphere = s.sphere_from_camera * point_in_camera + s.camera_in_sphere;
  const float longitude = std::atan2(on_sphere.y(), on_sphere.x());
  if (s.kind == Surface::Kind::kCylinder) return LocateOnCylinder(s, on_sphere, longitude);
  return {longitude * 0.5F * (s.radii_m.x() + s.radii_m.y()), on_sphere.z() * s.radii_m.z(),
          (s.sphere_from_camera.transpose() * on_sphere).normalized()};
}

/// The scene's far light, or what the lamps nearby are together, without shadows.
LocalLight LightAt(const Scene& scene, const Eigen::Vector3d& point_in_world,
                   const Eigen::Quaterniond& camera_from_world) {
  constexpr double kReach_m = 4.5;
  constexpr double kMoreAmbient = 1.5;  // light from the walls, which upright people need
  if (scene.lighting().lamps.empty()) {
    return {(camera_from_world * scene.light_in_world()).cast<float>(), 0.55F, 0.45F};
  }
  Eigen::Vector3d sum(0, 0, 1e-3);
  for (const Lamp& lamp : scene.lighting().lamps) {
    const Eigen::Vector3d to_lamp = lamp.centre_in_world - point_in_world;
    if (to_lamp.norm() > kReach_m) continue;
    const Eigen::Vector3d direction = to_lamp.normalized();
    sum += UnshadowedLight(lamp, point_in_world, direction) * direction;
  }
  return {(camera_from_world * sum.normalized()).cast<float>(),
          static_cast<float>(kMoreAmbient * scene.lighting().ambient),
          static_cast<float>(sum.norm())};
}

}  // namespace

std::vector<Surface> MakeSurfaces(const Scene& scene, double time_s,
                                  const RigidTransform& camera_from_world) {
  std::vector<Surface> surfaces;
  int part_index = 0;
  for (const Body& body : scene.bodies()) {
    const std::vector<RigidTransform> places = WorldFromParts(body, time_s);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Part& part = body.parts[k];
      const RigidTransform camera_from_part = camera_from_world * places[k];
      const Look look{part.texture.get(),
                      part.texture_offset_m.cast<float>(),
                      static_cast<std::uint8_t>(body.id.value),
                      part_index++,
                      static_cast<float>(part.glow),
                      LightAt(scene, places[k].translation(), camera_from_world.rotation()),
                      &scene.baked()};
      switch (part.shape) {
        case Shape::kRectangle: {
          const Eigen::Matrix3d axes = camera_from_part.RotationMatrix();
          AddRectangle({camera_from_part.translation(), axes.col(0), axes.col(1),
                        part.half_extent_m.x(), part.half_extent_m.y()},
                       look, 0, surfaces);
          break;
        }
        case Shape::kBox:
          AddBox(part, camera_from_part, look, surfaces);
          break;
        case Shape::kEllipsoid:
        case Shape::kCylinder:
          AddRound(part, camera_from_part, look, surfaces);
          break;
      }
    }
  }
  return surfaces;
}

void IntersectSpan(const Surface& surface, int index, const RaySpan& span) {
  if (surface.kind == Surface::Kind::kPlane) {
    IntersectPlane(surface, index, span);
  } else if (surface.kind == Surface::Kind::kCylinder) {
    IntersectCylinder(surface, index, span);
  } else {
    IntersectEllipsoid(surface, index, span);
  }
}

Eigen::Array3f ShadeSurface(const Surface& surface, const Eigen::Vector2f& ray_xy, float depth_m,
                            float pixel_angle) {
  constexpr float kMinCosine = 0.2F;  // beyond it the footprint grows no further
  const Eigen::Vector3f ray(ray_xy.x(), ray_xy.y(), 1);
  const SurfacePoint point = Locate(surface, ray * depth_m);
  const float cosine = std::abs(point.normal_in_camera.dot(ray)) / ray.norm();
  const float footprint_m = pixel_angle * depth_m / std::max(cosine, kMinCosine);
  const Eigen::Array3f color =
      surface.texture->Sample(point.u_m + surface.texture_offset_m.x(),
                              point.v_m + surface.texture_offset_m.y(), footprint_m);
  if (surface.light_map != nullptr) {
    return color * (surface.glow + surface.light_map->At(point.u_m, point.v_m));
  }
  const float diffuse = std::max(0.0F, point.normal_in_camera.dot(surface.light_in_camera));
  return color * (surface.glow + (surface.ambient + surface.diffuse * diffuse));
}

}  // namespace ofm
