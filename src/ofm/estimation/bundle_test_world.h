// A room of landmarks and a ring of cameras, for the tests and the benchmark of bundle adjustment.
#pragma once

#include <algorithm>

#include "ofm/base/check.h"
#include "ofm/estimation/bundle_adjustment.h"
#include "ofm/estimation/test_world.h"

namespace ofm::test {

struct BundleWorldOptions {
  int fixed_poses = 2, free_poses = 6;
  int points = 200;
  int views = 5;  ///< of each point, at most
  Depths depths = Depths::kEverySecond;
  Noise noise = {};
  double pose_sigma_m = 0.02, pose_sigma_rad = 0.01;  ///< error of the free poses' first guess
  double point_sigma_m = 0.03;                        ///< error of the points' first guess
};

struct BundleWorld {
  PinholeCamera camera = *FindCameraPreset("tum-fr1");
  BundleProblem truth;    ///< true poses and points
  BundleProblem problem;  ///< the same observations, with free poses and points off the truth
};

/// A camera that looks at a room's far wall, 3 to 6 m away, from a place within a metre.
inline RigidTransform RandomRoomPose(RandomEngine& engine) {
  return ExpSe3(RandomTwist(engine, 0.4, 0.1));
}

inline void AddViews(const Eigen::Vector3d& point_in_world, const BundleWorldOptions& options,
                     BundleWorld& world, RandomEngine& engine) {
  BundleProblem& truth = world.truth;
  const int poses = static_cast<int>(truth.poses.size());
  constexpr int kStep = 11;  // through the list of poses, so that it comes by each
  OFM_CHECK(poses % kStep != 0);
  const int first = static_cast<int>(UniformIndex(engine, poses));
  const int point = static_cast<int>(truth.points_in_world.size());
  int views = 0;
  for (int i = 0; i < poses && views < options.views; ++i) {
    const int pose = (first + kStep * i) % poses;
    const Eigen::Vector3d in_camera = truth.poses[pose].camera_from_world * point_in_world;
    if (in_camera.z() < 0.5 || !world.camera.IsInImage(world.camera.ProjectIdeal(in_camera))) {
      continue;
    }
    PointObservation seen = Observe(world.camera, in_camera, options.noise, engine);
    if (options.depths == Depths::kNone ||
        (options.depths == Depths::kEverySecond && (views + point) % 2)) {
      seen.depth_m = 0;
    }
    truth.observations.push_back({pose, point, seen});
    ++views;
  }
  truth.points_in_world.push_back(point_in_world);
}

inline BundleWorld MakeBundleWorld(const BundleWorldOptions& options, RandomEngine& engine) {
  BundleWorld world;
  for (int i = 0; i < options.fixed_poses + options.free_poses; ++i) {
    world.truth.poses.push_back({RandomRoomPose(engine), i < options.fixed_poses});
  }
  while (static_cast<int>(world.truth.points_in_world.size()) < options.points) {
    const double x = UniformReal(engine), y = UniformReal(engine), z = UniformReal(engine);
    AddViews({4 * x - 2, 3 * y - 1.5, 3 + 3 * z}, options, world, engine);
  }
  world.problem = world.truth;
  for (BundleProblem::Pose& pose : world.problem.poses) {
    const RigidTransform error =
        ExpSe3(RandomTwist(engine, options.pose_sigma_m, options.pose_sigma_rad));
    if (!pose.fixed) pose.camera_from_world = error * pose.camera_from_world;
  }
  for (Eigen::Vector3d& point : world.problem.points_in_world) {
    point += RandomTwist(engine, options.point_sigma_m, 0).head<3>();
  }
  return world;
}

/// Gives every `step`-th observation another pixel.
inline void SpoilEvery(int step, BundleWorld& world, RandomEngine& engine) {
  for (std::size_t i = 0; i < world.problem.observations.size(); i += step) {
    world.problem.observations[i].seen.ideal_px = RandomPixel(world.camera, engine);
  }
}

/// Root mean square [m] of the distances between the camera centres of free poses and the truth's.
inline double PositionError_m(const BundleWorld& world,
                              const std::vector<RigidTransform>& camera_from_world) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < camera_from_world.size(); ++i) {
    if (world.truth.poses[i].fixed) continue;
    const Eigen::Vector3d truth = world.truth.poses[i].camera_from_world.Inverse().translation();
    sum += (camera_from_world[i].Inverse().translation() - truth).squaredNorm();
    ++count;
  }
  return std::sqrt(sum / std::max(count, 1));
}

}  // namespace ofm::test
