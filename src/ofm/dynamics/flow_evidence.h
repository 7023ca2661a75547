// What the camera's own motion does not explain, cell by cell.
#pragma once

#include <opencv2/core.hpp>

#include "ofm/dynamics/camera_motion.h"

namespace ofm {

/// Log-likelihood ratio of moving against static per cell of `pair.current` (CV_32FC1; 0 without
/// texture or depth). The cell's point is carried into the last frame by the camera's motion; the
/// residual is the distance there from where flow found it, and the difference in inverse depth
/// (the least within one cell around), both in standard deviations. The image's deviation is never
/// under what the believed static cells have: blur makes flow worse everywhere.
cv::Mat FlowEvidence(const PinholeCamera& lattice_camera, const LatticePair& pair,
                     const RigidTransform& last_from_current, const MotionOptions& options);

}  // namespace ofm
