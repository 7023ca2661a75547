#include "ofm/estimation/minimal_pose.h"

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <optional>

#include "ofm/base/check.h"
#include "ofm/estimation/reprojection.h"
#include "ofm/geometry/alignment.h"

namespace ofm {
namespace {

/// True where the triangle's smallest height is under a thousandth of its longest side.
bool IsNearlyInLine(const MinimalSample& sample) {
  const Eigen::Vector3d a = sample[1].point_in_world - sample[0].point_in_world;
  const Eigen::Vector3d b = sample[2].point_in_world - sample[0].point_in_world;
  const double longest2 = std::max({a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm()});
  return a.cross(b).norm() <= 1e-3 * longest2;
}

}  // namespace

std::vector<RigidTransform> PosesFromDepth(const PinholeCamera& camera,
                                           const MinimalSample& sample) {
  std::array<Eigen::Vector3d, 3> in_world, in_camera;
  for (int i = 0; i < 3; ++i) {
    const PointObservation& seen = sample[i].seen;
    OFM_CHECK(HasDepth(seen));
    in_world[i] = sample[i].point_in_world;
    in_camera[i] = camera.UnprojectIdeal(seen.ideal_px, seen.depth_m);
  }
  if (IsNearlyInLine(sample)) return {};
  const std::optional<RigidTransform> pose = AlignRigid(in_world, in_camera);
  return pose ? std::vector{*pose} : std::vector<RigidTransform>();
}

std::vector<RigidTransform> PosesFromPixels(const PinholeCamera& camera,
                                            const MinimalSample& sample) {
  if (IsNearlyInLine(sample)) return {};
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> rays;  // in the normalised image
  for (const auto& [point, seen] : sample) {
    const Eigen::Vector3d ray = camera.UnprojectIdeal(seen.ideal_px, 1);
    points.emplace_back(point.x(), point.y(), point.z());
    rays.emplace_back(ray.x(), ray.y());
  }
  std::vector<cv::Mat> rotations, translations;
  cv::solveP3P(points, rays, cv::Matx33d::eye(), cv::noArray(), rotations, translations,
               cv::SOLVEPNP_AP3P);
  std::vector<RigidTransform> poses;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const cv::Vec3d r(rotations[i]), t(translations[i]);
    const RigidTransform pose(ExpSo3({r[0], r[1], r[2]}), Eigen::Vector3d(t[0], t[1], t[2]));
    if (pose.IsFinite()) poses.push_back(pose);
  }
  return poses;
}

}  // namespace ofm
