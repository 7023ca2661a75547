#include "ofm/sim/light_baker.h"

#include <array>
#include <numbers>

#include "ofm/sim/occluders.h"
#include "ofm/sim/scene.h"

namespace ofm {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kCell_m = 0.15;
constexpr double kSmall_m = 0.13;     // half the size of faces that have one value
constexpr float kLift_m = 0.01F;      // of the points above their own face
constexpr float kAmbientReach_m = 1;  // what is farther away takes no light of all sides
constexpr double kLampReach_m = 7;    // farther lamps give nothing

/// A face in the world: middle, directions of u, v and outwards, half sizes.
struct Face {
  Vector3d centre, axis_u, axis_v, normal;
  double half_u, half_v;

  Vector3d At(double u, double v) const { return centre + u * axis_u + v * axis_v; }
  Eigen::AlignedBox3f Bounds() const {
    Eigen::AlignedBox3f box;
    for (const double u : {-half_u, half_u}) {
      for (const double v : {-half_v, half_v}) box.extend(At(u, v).cast<float>().eval());
    }
    return box;
  }
};

/// Directions about +z whose density is as the cosine (Hammersley points).
std::vector<Vector3f> CosineDirections() {
  constexpr int kCount = 20;
  std::vector<Vector3f> directions;
  for (int i = 0; i < kCount; ++i) {
    double radical = 0;
    for (int bits = i, digit = 2; bits > 0; bits >>= 1, digit *= 2) {
      radical += static_cast<double>(bits & 1) / digit;
    }
    const double radius = std::sqrt((i + 0.5) / kCount);
    const double angle = 2 * std::numbers::pi * radical;
    directions.emplace_back(
        Vector3d(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - radius * radius))
            .cast<float>());
  }
  return directions;
}

/// Bakes faces of one scene.
class FaceBaker {
 public:
  FaceBaker(const std::vector<Body>& bodies, const Lighting& lighting)
      : occluders_(bodies), lighting_(lighting) {}

  LightMap Bake(const Face& face) const {
    if (std::max(face.half_u, face.half_v) < kSmall_m) return BakeSmall(face);
    const int columns = 2 + static_cast<int>(2 * face.half_u / kCell_m);
    const int rows = 2 + static_cast<int>(2 * face.half_v / kCell_m);
    std::vector<float> values(static_cast<std::size_t>(columns) * rows);
    const FaceLight light = LightOn(face);
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) {
        values[r * columns + c] = static_cast<float>(
            At(light, NodeAt(face, 2.0 * c / (columns - 1) - 1, 2.0 * r / (rows - 1) - 1)));
      }
    }
    return {columns, rows, Eigen::Vector2d(face.half_u, face.half_v).cast<float>(), values};
  }

 private:
  /// What can lie between a lamp and a face.
  struct LampOnFace {
    const Lamp* lamp;
    std::vector<int> between;
  };
  /// What decides the light on a face.
  struct FaceLight {
    const Face* face;
    std::vector<int> close;
    std::vector<LampOnFace> lamps;
  };

  LightMap BakeSmall(const Face& face) const {
    const auto value = static_cast<float>(At(LightOn(face), NodeAt(face, 0, 0)));
    return {2, 2, Eigen::Vector2d(face.half_u, face.half_v).cast<float>(),
            std::vector<float>(4, value)};
  }

  FaceLight LightOn(const Face& face) const {
    const Eigen::AlignedBox3f bounds = face.Bounds();
    const Vector3f reach = Vector3f::Constant(kAmbientReach_m);
    FaceLight light{&face, occluders_.Near({bounds.min() - reach, bounds.max() + reach}), {}};
    for (const Lamp& lamp : lighting_.lamps) {
      const Vector3f centre = lamp.centre_in_world.cast<float>();
      if (bounds.exteriorDistance(centre) > kLampReach_m) continue;
      light.lamps.push_back({&lamp, occluders_.Near(Eigen::AlignedBox3f(bounds).extend(centre))});
    }
    return light;
  }

  double At(const FaceLight& light, const Vector3d& point) const {
    double sum = Ambient(*light.face, point, light.close);
    for (const LampOnFace& from : light.lamps) {
      sum += FromLamp(*from.lamp, *light.face, point, from.between);
    }
    return sum;
  }

  /// A node a little within the face: at its very edge it would lie in the neighbour's surface.
  static Vector3d NodeAt(const Face& face, double u_share, double v_share) {
    const double inner_u = std::max(face.half_u - 0.02, 0.5 * face.half_u);
    const double inner_v = std::max(face.half_v - 0.02, 0.5 * face.half_v);
    return face.At(u_share * inner_u, v_share * inner_v) + kLift_m * face.normal;
  }

  double Ambient(const Face& face, const Vector3d& point, const std::vector<int>& close) const {
    Eigen::Matrix3f axes;
    axes << face.axis_u.cast<float>(), face.axis_v.cast<float>(), face.normal.cast<float>();
    float open = 0;
    for (const Vector3f& direction : directions_) {
      open += occluders_.FirstHit(point.cast<float>(), kAmbientReach_m * (axes * direction), close);
    }
    return lighting_.ambient * open / static_cast<double>(directions_.size());
  }

  double FromLamp(const Lamp& lamp, const Face& face, const Vector3d& point,
                  const std::vector<int>& candidates) const {
    constexpr std::array<double, 3> kGrid = {-0.7, 0, 0.7};
    const double light = UnshadowedLight(lamp, point, face.normal);
    if (light < 2e-3) return 0;
    int seen = 0;
    for (const double x : kGrid) {
      for (const double y : kGrid) {
        const Vector3d target = lamp.centre_in_world + Vector3d(x * lamp.half_extent_m.x(),
                                                                y * lamp.half_extent_m.y(), -0.02);
        const Vector3d ray = target - point;
        if (!occluders_.IsHidden(point.cast<float>(), ray.cast<float>(), candidates)) ++seen;
      }
    }
    return light * seen / (kGrid.size() * kGrid.size());
  }

  Occluders occluders_;
  const Lighting& lighting_;
  std::vector<Vector3f> directions_ = CosineDirections();
};

Face BoxFace(const Part& part, const RigidTransform& world_from_part, int number) {
  const int axis = number / 2;
  const double side = number % 2 == 0 ? -1 : 1;
  const Eigen::Matrix3d axes = world_from_part.RotationMatrix();
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  return {world_from_part.translation() + side * part.half_extent_m[axis] * axes.col(axis),
          axes.col(u),
          axes.col(v),
          side * axes.col(axis),
          part.half_extent_m[u],
          part.half_extent_m[v]};
}

}  // namespace

double UnshadowedLight(const Lamp& lamp, const Vector3d& point_in_world,
                       const Vector3d& normal_in_world) {
  constexpr double kSoftening_m2 = 0.3;  // a lamp is no point: near it the light stays finite
  const Vector3d to_lamp = lamp.centre_in_world - point_in_world;
  const double distance2 = to_lamp.squaredNorm();
  const double distance = std::sqrt(distance2);
  const double received = to_lamp.dot(normal_in_world) / distance;
  const double sent = to_lamp.z() / distance;  // the lamp looks down
  if (received <= 0 || sent <= 0) return 0;
  return lamp.intensity * (1 + kSoftening_m2) * received * std::sqrt(sent) /
         (distance2 + kSoftening_m2);
}

BakedLight BakeLight(const std::vector<Body>& bodies, const Lighting& lighting) {
  const FaceBaker baker(bodies, lighting);
  BakedLight baked;
  int part_index = 0;
  for (const Body& body : bodies) {
    const std::vector<RigidTransform> places = WorldFromParts(body, 0);
    for (std::size_t k = 0; k < places.size(); ++k, ++part_index) {
      const Part& part = body.parts[k];
      if (IsMoving(body.motion) || part.glow > 0) continue;
      if (part.shape == Shape::kRectangle) {
        const Eigen::Matrix3d axes = places[k].RotationMatrix();
        baked.emplace(std::pair(part_index, 0),
                      baker.Bake({places[k].translation(), axes.col(0), axes.col(1), axes.col(2),
                                  part.half_extent_m.x(), part.half_extent_m.y()}));
      } else if (part.shape == Shape::kBox) {
        for (int face = 0; face < 6; ++face) {
          baked.emplace(std::pair(part_index, face), baker.Bake(BoxFace(part, places[k], face)));
        }
      }
    }
  }
  return baked;
}

}  // namespace ofm
