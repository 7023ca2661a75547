// Landmarks, cameras that see them, and noise, made from a seed: under the estimators' tests and
// benchmarks.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "ofm/base/random.h"
#include "ofm/estimation/observation.h"
#include "ofm/estimation/pose_optimizer.h"

namespace ofm::test {

/// Standard normal (Box and Muller 1958).
inline double Normal(RandomEngine& engine) {
  const double radius = std::sqrt(-2 * std::log(1 - UniformReal(engine)));
  return radius * std::cos(2 * M_PI * UniformReal(engine));
}

/// A step whose elements are normal with these standard deviations.
inline Vector6d RandomTwist(RandomEngine& engine, double sigma_m, double sigma_rad) {
  Vector6d twist;
  for (int i = 0; i < 6; ++i) twist[i] = (i < 3 ? sigma_m : sigma_rad) * Normal(engine);
  return twist;
}

/// Anywhere in the image but for a border of 10 px.
inline Eigen::Vector2d RandomPixel(const PinholeCamera& camera, RandomEngine& engine) {
  const double u = UniformReal(engine), v = UniformReal(engine);
  return {10 + u * (camera.width - 20), 10 + v * (camera.height - 20)};
}

inline double RandomDepth_m(RandomEngine& engine) { return 0.5 + 4.5 * UniformReal(engine); }

/// Which observations have depth.
enum class Depths { kNone, kEverySecond, kAll };

struct Noise {
  double pixel_sigma = 1;               ///< [px]
  double inverse_depth_sigma = 1.4e-3;  ///< [1/m]
  double factor = 1;                    ///< of the noise that is drawn; 0 = exact measurements
};

/// What a camera measures of a point, depth included.
inline PointObservation Observe(const PinholeCamera& camera, const Eigen::Vector3d& point_in_camera,
                                const Noise& noise, RandomEngine& engine) {
  PointObservation seen;
  const double du = Normal(engine), dv = Normal(engine), dq = Normal(engine);
  seen.ideal_px = camera.ProjectIdeal(point_in_camera) +
                  noise.factor * noise.pixel_sigma * Eigen::Vector2d(du, dv);
  seen.depth_m = 1 / (1 / point_in_camera.z() + noise.factor * noise.inverse_depth_sigma * dq);
  seen.pixel_sigma = noise.pixel_sigma;
  seen.inverse_depth_sigma = noise.inverse_depth_sigma;
  return seen;
}

/// `count` landmarks in view of a camera at `camera_from_world`, as it sees them.
inline std::vector<PoseObservation> MakeFrame(const PinholeCamera& camera,
                                              const RigidTransform& camera_from_world, int count,
                                              Depths depths, const Noise& noise,
                                              RandomEngine& engine) {
  const RigidTransform world_from_camera = camera_from_world.Inverse();
  std::vector<PoseObservation> frame;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d pixel = RandomPixel(camera, engine);
    const Eigen::Vector3d point = camera.UnprojectIdeal(pixel, RandomDepth_m(engine));
    frame.push_back({world_from_camera * point, Observe(camera, point, noise, engine)});
    if (depths == Depths::kNone || (depths == Depths::kEverySecond && i % 2)) {
      frame.back().seen.depth_m = 0;
    }
  }
  return frame;
}

/// Moves the first `count` observations to other pixels and, where they have one, depths.
inline void Spoil(const PinholeCamera& camera, int count, std::vector<PoseObservation>& frame,
                  RandomEngine& engine) {
  for (int i = 0; i < count; ++i) {
    frame[i].seen.ideal_px = RandomPixel(camera, engine);
    const double depth_m = RandomDepth_m(engine);
    if (frame[i].seen.depth_m > 0) frame[i].seen.depth_m = depth_m;
  }
}

/// The left perturbation that takes `b` to `a`.
inline Vector6d Difference(const RigidTransform& a, const RigidTransform& b) {
  return LogSe3(a * b.Inverse());
}

}  // namespace ofm::test
