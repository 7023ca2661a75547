#include "ofm/dense/floor_plane.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "ofm/base/random.h"

namespace ofm {
namespace {

constexpr int kDraws = 1000;
constexpr int kRefinements = 5;
/// In voxels: the centres of the voxels that a plane crosses are this near, at any angle.
constexpr double kInlierDistance = .87;
/// In voxels: what is deeper than this is beneath the floor, not a part of its noise.
constexpr double kBeneath = 2.5;

struct Support {
  std::size_t inliers = 0, beneath = 0;
};

class FloorSearch {
 public:
  FloorSearch(std::span<const Eigen::Vector3f> surface, const Eigen::Vector3d& up,
              double resolution_m, const FloorOptions& options)
      : surface_(surface),
        up_(up),
        inlier_m_(kInlierDistance * resolution_m),
        beneath_m_(kBeneath * resolution_m),
        min_inliers_(options.min_area_m2 / (resolution_m * resolution_m)),
        max_beneath_(options.max_share_beneath * static_cast<double>(surface.size())),
        min_cosine_(std::cos(options.max_tilt_deg * M_PI / 180)) {}

  std::optional<Plane> Find() const {
    std::optional<Plane> best;
    std::size_t most = 0;
    RandomEngine engine = MakeRandomEngine(0, surface_.size());
    for (int draw = 0; draw < kDraws; ++draw) {
      const std::optional<Plane> plane = Draw(engine);
      if (!plane) continue;
      const Support support = SupportOf(*plane);
      if (support.inliers <= most || !IsFloor(support)) continue;
      most = support.inliers;
      best = plane;
    }
    for (int i = 0; best && i < kRefinements; ++i) best = Refine(*best);
    return best && IsFloor(SupportOf(*best)) ? best : std::nullopt;
  }

 private:
  Eigen::Vector3d Any(RandomEngine& engine) const {
    return surface_[UniformIndex(engine, static_cast<std::uint32_t>(surface_.size()))]
        .cast<double>();
  }

  /// Through three points; empty where it is no floor by its direction.
  std::optional<Plane> Draw(RandomEngine& engine) const {
    const Eigen::Vector3d a = Any(engine), b = Any(engine), c = Any(engine);
    return Oriented((b - a).cross(c - a), a);
  }

  std::optional<Plane> Oriented(const Eigen::Vector3d& direction,
                                const Eigen::Vector3d& point) const {
    const double length = direction.norm();
    if (length < 1e-9) return {};
    const Eigen::Vector3d normal = direction / (direction.dot(up_) < 0 ? -length : length);
    if (normal.dot(up_) < min_cosine_) return {};
    return Plane{normal, -normal.dot(point)};
  }

  Support SupportOf(const Plane& plane) const {
    Support support;
    for (const Eigen::Vector3f& point : surface_) {
      const double height_m = plane.Height_m(point.cast<double>());
      support.inliers += std::abs(height_m) <= inlier_m_;
      support.beneath += height_m < -beneath_m_;
    }
    return support;
  }

  bool IsFloor(const Support& support) const {
    return static_cast<double>(support.inliers) >= min_inliers_ &&
           static_cast<double>(support.beneath) <= max_beneath_;
  }

  /// Least squares over the inliers.
  std::optional<Plane> Refine(const Plane& plane) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    double count = 0;
    for (const Eigen::Vector3f& single : surface_) {
      const Eigen::Vector3d point = single.cast<double>();
      if (std::abs(plane.Height_m(point)) > inlier_m_) continue;
      sum += point;
      products += point * point.transpose();
      ++count;
    }
    const Eigen::Vector3d mean = sum / count;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(products / count -
                                                                mean * mean.transpose());
    return Oriented(solver.eigenvectors().col(0), mean);
  }

  std::span<const Eigen::Vector3f> surface_;
  Eigen::Vector3d up_;
  double inlier_m_, beneath_m_, min_inliers_, max_beneath_, min_cosine_;
};

}  // namespace

Eigen::Vector3d MeanUp(const std::map<KeyframeId, RigidTransform>& world_from_camera) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [id, pose] : world_from_camera) {
    if (pose.IsFinite()) sum -= pose.rotation() * Eigen::Vector3d::UnitY();
  }
  if (sum.norm() <= 1e-6) return -Eigen::Vector3d::UnitY();
  return sum.normalized();
}

std::optional<Plane> FindFloor(std::span<const Eigen::Vector3f> surface_in_world,
                               const Eigen::Vector3d& up_in_world, double resolution_m,
                               const FloorOptions& options) {
  if (surface_in_world.size() < 3) return {};
  return FloorSearch(surface_in_world, up_in_world, resolution_m, options).Find();
}

std::optional<Plane> FindFloor(const SemanticOctree& octree, const Eigen::Vector3d& up_in_world,
                               const FloorOptions& options) {
  std::vector<Eigen::Vector3f> surface;
  octree.ForEach([&](const VoxelIndex& index, const SemanticVoxel& voxel) {
    if (voxel.IsOccupied()) surface.push_back(VoxelCenter(index, octree.resolution_m()));
  });
  return FindFloor(surface, up_in_world, octree.resolution_m(), options);
}

}  // namespace ofm
