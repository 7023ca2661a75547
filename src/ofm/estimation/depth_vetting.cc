#include "ofm/estimation/depth_vetting.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ofm/base/median.h"
#include "ofm/estimation/reprojection.h"

namespace ofm {
namespace {

/// One observation counts for so many limits at most: it alone condemns few points.
constexpr double kMostLimits = 6;

/// An observation that counts.
struct Sighting {
  int pose, point;
  PointObservation seen;
  Eigen::Vector3d point_in_camera;
};

/// What the observers of a point say together.
struct PointEvidence {
  Eigen::Vector3d sum_of_centres = Eigen::Vector3d::Zero();  ///< of the cameras, in the world
  int views = 0;
  double parallax_information = 0;  ///< about the inverse depth as seen from their mean [m^2]
  double sum_of_residuals = 0;      ///< of inverse depth [1/m]
  int depths = 0;
};

/// Those with weight, of points before the camera.
std::vector<Sighting> FindSightings(std::span<const RigidTransform> camera_from_world,
                                    std::span<const Eigen::Vector3d> points_in_world,
                                    std::span<const BundleProblem::Observation> observations) {
  std::vector<Sighting> sightings;
  sightings.reserve(observations.size());
  for (const auto& [pose, point, seen] : observations) {
    const Eigen::Vector3d in_camera = camera_from_world[pose] * points_in_world[point];
    if (seen.weight > 0 && IsBeforeCamera(in_camera)) {
      sightings.push_back({pose, point, seen, in_camera});
    }
  }
  return sightings;
}

/// The median over all depths of triangulated over measured; 1 where there are none.
double CommonScale(const std::vector<Sighting>& sightings) {
  std::vector<double> ratios;
  for (const Sighting& s : sightings) {
    if (HasDepth(s.seen)) ratios.push_back(s.point_in_camera.z() / s.seen.depth_m);
  }
  return ratios.empty() ? 1 : UpperMedian(std::move(ratios));
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
  const std::vector<Sighting> sightings =
      FindSightings(camera_from_world, points_in_world, observations);
  std::vector<Eigen::Vector3d> centres;
  for (const RigidTransform& pose : camera_from_world) {
    centres.push_back(pose.Inverse().translation());
  }
  std::vector<PointEvidence> evidence(points_in_world.size());
  for (const Sighting& s : sightings) {
    evidence[s.point].sum_of_centres += centres[s.pose];
    ++evidence[s.point].views;
  }
  const double scale = CommonScale(sightings);
  const double most = kMostLimits * options.max_residual;
  for (const Sighting& s : sightings) {
    PointEvidence& point = evidence[s.point];
    const Eigen::Vector3d centre = camera_from_world[s.pose] * (point.sum_of_centres / point.views);
    point.parallax_information += ParallaxInformation(camera, s.point_in_camera, centre, s.seen);
    if (!HasDepth(s.seen)) continue;
    point.sum_of_residuals +=
        std::clamp(1 / s.seen.depth_m - scale / s.point_in_camera.z(), -most, most);
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
