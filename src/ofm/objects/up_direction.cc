#include "ofm/objects/up_direction.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ofm/dense/floor_plane.h"

namespace ofm {
namespace {

constexpr double kMaxTilt_rad = 50 * M_PI / 180;
constexpr double kSameNormal_rad = 5 * M_PI / 180;
constexpr double kMaxBend_share = 0.03;  // of the inverse depth, along three cells of a plane
constexpr std::size_t kNormals = 4000;   // looked at, at most
constexpr std::size_t kCandidates = 200;
constexpr std::size_t kMinNormals = 50;  // that must agree

/// Calls `use` with the normal, towards the camera, of every surface cell of a sketch.
template <class Use>
void ForEachNormal(const PinholeCamera& camera, const DepthSketch& depth, Use&& use) {
  constexpr int kStep = DepthSketch::kStep_px;
  const auto point = [&](int column, int row) {
    const Eigen::Vector2d ideal(column * kStep + kStep / 2, row * kStep + kStep / 2);
    return camera.UnprojectIdeal(ideal, depth.At(column, row));
  };
  // Along a line of the image, a plane's inverse depth is linear.
  const auto is_straight = [](double first_m, double middle_m, double last_m) {
    return first_m > 0 && middle_m > 0 && last_m > 0 &&
           std::abs(1 / first_m - 2 / middle_m + 1 / last_m) < kMaxBend_share / middle_m;
  };
  for (int row = 0; row + 2 < depth.rows; row += 2) {
    for (int column = 0; column + 2 < depth.columns; column += 2) {
      const double here_m = depth.At(column, row);
      if (!is_straight(here_m, depth.At(column + 1, row), depth.At(column + 2, row)) ||
          !is_straight(here_m, depth.At(column, row + 1), depth.At(column, row + 2))) {
        continue;
      }
      const Eigen::Vector3d here = point(column, row), right = point(column + 2, row),
                            below = point(column, row + 2);
      use((below - here).cross(right - here).normalized());
    }
  }
}

/// Every n-th, so that `count` are left at most.
std::vector<Eigen::Vector3d> Thin(const std::vector<Eigen::Vector3d>& all, std::size_t count) {
  std::vector<Eigen::Vector3d> some;
  const std::size_t step = all.size() / count + 1;
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

}  // namespace

Eigen::Vector3d EstimateUp(const PinholeCamera& camera,
                           const std::map<KeyframeId, KeyframeObjects>& keyframes,
                           const std::map<KeyframeId, RigidTransform>& world_from_camera) {
  const Eigen::Vector3d mean = MeanUp(world_from_camera);
  std::vector<Eigen::Vector3d> upward;
  for (const auto& [id, keyframe] : keyframes) {
    const auto pose = world_from_camera.find(id);
    if (pose == world_from_camera.end() || !pose->second.IsFinite()) continue;
    ForEachNormal(camera, keyframe.depth, [&](const Eigen::Vector3d& normal_in_camera) {
      const Eigen::Vector3d normal = pose->second.rotation() * normal_in_camera;
      if (normal.dot(mean) > std::cos(kMaxTilt_rad)) upward.push_back(normal);
    });
  }
  const std::vector<Eigen::Vector3d> normals = Thin(upward, kNormals);
  Eigen::Vector3d best = mean;
  std::size_t most = std::min(kMinNormals, normals.size() / 10 + 1);
  for (const Eigen::Vector3d& candidate : Thin(normals, kCandidates)) {
    Eigen::Vector3d agreeing = Eigen::Vector3d::Zero();
    std::size_t count = 0;
    for (const Eigen::Vector3d& normal : normals) {
      if (normal.dot(candidate) < std::cos(kSameNormal_rad)) continue;
      agreeing += normal;
      ++count;
    }
    if (count <= most) continue;
    most = count;
    best = agreeing.normalized();
  }
  return best;
}

}  // namespace ofm
