#include "ofm/estimation/depth_vetting.h"

#include <algorithm>
#include <cmath>

#include "ofm/estimation/reprojection.h"

namespace ofm {
namespace {

/// One observation counts for so many limits at most: it alone condemns few points.
constexpr double kMostLimits = 6;

/// What the observers of a point say together.
struct PointEvidence {
  Eigen::Vector3d sum_of_centres = Eigen::Vector3d::Zero();  ///< of the cameras, in the world
  int views = 0;
  double parallax_information = 0;  ///< about the inverse depth as seen from their mean [m^2]
  double sum_of_residuals = 0;      ///< of inverse depth [1/m]
  int depths = 0;
};

/// The median over all depths of triangulated over measured; 1 where there are none.
double CommonScale(std::vector<double> ratios) {
  if (ratios.empty()) return 1;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle;
}

/// What the pixel of an observation says about the point's inverse depth as seen from `centre`.
double ParallaxInformation(const PinholeCamera& camera, const Eigen::Vector3d& point_in_camera,
                           const Eigen::Vector3d& centre_in_camera, PointObservation seen) {
  seen.depth_m = 0;
  const Eigen::Vector3d by_inverse_depth =
      -point_in_camera.z() * (point_in_camera - centre_in_camera);
  return (ReprojectionJacobian(camera, point_in_camera, seen) * by_inverse_depth).squaredNorm();
}

}  // namespace

std::vector<char> FindContradictedDepths(const PinholeCamera& camera,
                                         std::span<const RigidTransform> camera_from_world,
                                         std::span<const Eigen::Vector3d> points_in_world,
                                         std::span<const BundleProblem::Observation> observations,
                                         const DepthVettingOptions& options) {
  std::vector<Eigen::Vector3d> centres;
  centres.reserve(camera_from_world.size());
  for (const RigidTransform& pose : camera_from_world) {
    centres.push_back(pose.Inverse().translation());
  }
  std::vector<PointEvidence> evidence(points_in_world.size());
  std::vector<double> ratios;
  const auto in_camera = [&](const BundleProblem::Observation& o) {
    return camera_from_world[o.pose] * points_in_world[o.point];
  };
  const auto counts = [&](const BundleProblem::Observation& o) {
    return o.seen.weight > 0 && IsBeforeCamera(in_camera(o));
  };
  for (const auto& o : observations) {
    if (!counts(o)) continue;
    evidence[o.point].sum_of_centres += centres[o.pose];
    ++evidence[o.point].views;
    if (HasDepth(o.seen)) ratios.push_back(in_camera(o).z() / o.seen.depth_m);
  }
  const double scale = CommonScale(std::move(ratios));
  const double most = kMostLimits * options.max_residual;
  for (const auto& o : observations) {
    if (!counts(o)) continue;
    PointEvidence& point = evidence[o.point];
    const Eigen::Vector3d p = in_camera(o);
    const Eigen::Vector3d centre = camera_from_world[o.pose] * (point.sum_of_centres / point.views);
    point.parallax_information += ParallaxInformation(camera, p, centre, o.seen);
    if (!HasDepth(o.seen)) continue;
    point.sum_of_residuals += std::clamp(1 / o.seen.depth_m - scale / p.z(), -most, most);
    ++point.depths;
  }
  const double least_information = 1 / (options.max_parallax_sigma * options.max_parallax_sigma);
  std::vector<char> contradicted;
  contradicted.reserve(evidence.size());
  for (const PointEvidence& point : evidence) {
    contradicted.push_back(point.parallax_information >= least_information &&
                           std::abs(point.sum_of_residuals) > options.max_residual * point.depths);
  }
  return contradicted;
}

}  // namespace ofm
