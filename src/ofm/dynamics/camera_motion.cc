#include "ofm/dynamics/camera_motion.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ofm/estimation/pnp.h"
#include "ofm/estimation/pose_optimizer.h"

namespace ofm {
namespace {

float DepthAt(const cv::Mat& depth_m, const Eigen::Vector2d& cell) {
  const int x = static_cast<int>(std::lround(cell.x())),
            y = static_cast<int>(std::lround(cell.y()));
  if (x < 0 || y < 0 || x >= depth_m.cols || y >= depth_m.rows) return 0;
  return depth_m.at<float>(y, x);
}

/// The first textured cell with depth, believed static, in each block, searched from its middle.
std::vector<cv::Point> ChooseCells(const LatticePair& pair, int block) {
  std::vector<cv::Point> cells;
  const auto usable = [&](int x, int y) {
    return pair.current.texture.at<std::uint8_t>(y, x) != 0 &&
           pair.current.depth_m.at<float>(y, x) > 0 && pair.belief.at<float>(y, x) < 0;
  };
  for (int top = 0; top + block <= pair.flow.rows; top += block) {
    for (int left = 0; left + block <= pair.flow.cols; left += block) {
      for (int k = 0; k < block * block; ++k) {
        const int place = (k + block * block / 2) % (block * block);
        const cv::Point cell(left + place % block, top + place / block);
        if (!usable(cell.x, cell.y)) continue;
        cells.push_back(cell);
        break;
      }
    }
  }
  return cells;
}

/// The chosen cells' points and where flow found them.
std::vector<PoseObservation> Observe(const PinholeCamera& camera, const LatticePair& pair,
                                     const MotionOptions& options) {
  const double sigma_cells = options.camera_motion.pixel_sigma / options.lattice.cell_px;
  std::vector<PoseObservation> observations;
  for (const cv::Point& cell : ChooseCells(pair, options.camera_motion.block_cells)) {
    const cv::Vec2f flow = pair.flow.at<cv::Vec2f>(cell);
    const Eigen::Vector2d seen(cell.x + flow[0], cell.y + flow[1]);
    if (!camera.IsInImage(seen)) continue;
    PoseObservation observation;
    observation.point_in_world =
        camera.UnprojectIdeal({cell.x, cell.y}, pair.current.depth_m.at<float>(cell));
    observation.seen.ideal_px = seen;
    observation.seen.depth_m = DepthAt(pair.last.depth_m, seen);
    observation.seen.pixel_sigma = sigma_cells;
    observation.seen.inverse_depth_sigma = options.flow.inverse_depth_sigma;
    observations.push_back(observation);
  }
  return observations;
}

/// The motion that most observations agree with.
CameraMotion EstimateFrom(const std::vector<PoseObservation>& observations,
                          const PinholeCamera& camera, const RigidTransform& predicted,
                          const CameraMotionOptions& options, RandomEngine& engine) {
  CameraMotion result{predicted};
  const auto consider = [&](const PoseEstimate& pose) {
    const double share = static_cast<double>(pose.inlier_count) / observations.size();
    if (!pose.converged || pose.inlier_count < options.min_points || share <= result.inlier_share) {
      return;
    }
    result = {pose.camera_from_world, share, true};
  };
  consider(OptimizePose(camera, predicted, observations, PoseOptimizerOptions{}));
  if (result.inlier_share < options.doubtful_share) {
    PnpOptions pnp;
    pnp.iterations = options.ransac_iterations;
    pnp.min_inliers = options.min_points;
    if (const auto pose = EstimatePoseRansac(camera, observations, pnp, engine)) consider(*pose);
  }
  return result;
}

}  // namespace

CameraMotion EstimateCameraMotion(const PinholeCamera& lattice_camera, const LatticePair& pair,
                                  const RigidTransform& predicted, const MotionOptions& options,
                                  RandomEngine& engine) {
  const CameraMotionOptions& motion = options.camera_motion;
  std::vector<PoseObservation> observations = Observe(lattice_camera, pair, options);
  CameraMotion none{predicted};
  if (static_cast<int>(observations.size()) < motion.min_points) return none;
  const CameraMotion sharp = EstimateFrom(observations, lattice_camera, predicted, motion, engine);
  if (sharp.inlier_share >= motion.blurred_share) return sharp;
  for (PoseObservation& observation : observations) {
    observation.seen.pixel_sigma = motion.blurred_pixel_sigma / options.lattice.cell_px;
  }
  const CameraMotion blurred =
      EstimateFrom(observations, lattice_camera, predicted, motion, engine);
  if (blurred.inlier_share >= motion.blurred_share) return blurred;
  none.is_contradicted = true;
  return none;
}

}  // namespace ofm
