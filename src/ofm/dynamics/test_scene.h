// Two views of made points, some of which move on their own.
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "ofm/base/random.h"
#include "ofm/camera/pinhole_camera.h"
#include "ofm/perception/optical_flow.h"

namespace ofm::test {

/// What the camera and one mover do between two frames.
struct Motion {
  Eigen::Vector3d camera_shift_m = {0.03, 0.01, 0.02};
  Eigen::Vector3d camera_turn_rad = {0.005, -0.01, 0.01};
  Eigen::Vector3d mover_shift_m = {0, 0, 0};
  double noise_px = 0.15;  ///< largest error in x and y of a point found again
};

/// Flow of static points all over the image, then of points on a mover, an upright board.
struct Scene {
  PinholeCamera camera = *FindCameraPreset("tum-fr1");
  int static_count = 400;
  int mover_count = 0;
  double mover_left_px = 100, mover_right_px = 300;  ///< columns of the board in the first image

  FlowResult Flow(const Motion& motion, std::uint64_t seed) const {
    RandomEngine engine = MakeRandomEngine(seed, 0);
    const auto uniform = [&](double low, double high) {
      return low + (high - low) * UniformReal(engine);
    };
    const Eigen::AngleAxisd turn(motion.camera_turn_rad.norm(),
                                 motion.camera_turn_rad.norm() > 0
                                     ? motion.camera_turn_rad.normalized().eval()
                                     : Eigen::Vector3d::UnitX().eval());
    FlowResult flow;
    const auto add = [&](const Eigen::Vector2d& pixel, double depth_m,
                         const Eigen::Vector3d& own_shift_m) {
      const Eigen::Vector3d point = camera.UnprojectIdeal(camera.Undistort(pixel), depth_m);
      const Eigen::Vector3d moved = turn.inverse() * (point + own_shift_m - motion.camera_shift_m);
      const Eigen::Vector2d noise(uniform(-1, 1), uniform(-1, 1));
      const Eigen::Vector2d seen = camera.Project(moved) + motion.noise_px * noise;
      flow.previous.push_back(pixel.cast<float>());
      flow.current.push_back(seen.cast<float>());
      flow.status.push_back(camera.IsInImage(seen) ? FlowStatus::kTracked : FlowStatus::kLost);
    };
    for (int i = 0; i < static_count; ++i) {
      const double x = uniform(0, 639), y = uniform(0, 479);
      add({x, y}, uniform(0.8, 4), Eigen::Vector3d::Zero());
    }
    for (int i = 0; i < mover_count; ++i) {
      const double x = uniform(mover_left_px, mover_right_px), y = uniform(120, 400);
      add({x, y}, 1.5, motion.mover_shift_m);
    }
    return flow;
  }
};

}  // namespace ofm::test
