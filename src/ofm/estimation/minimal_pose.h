// Camera poses from three matches, the fewest that fix one.
#pragma once

#include <array>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/estimation/pose_optimizer.h"

namespace ofm {

using MinimalSample = std::array<PoseObservation, 3>;

/// The camera_from_world that brings the three points onto those that were measured with depth
/// (Umeyama 1991): one, or none where they are in one line. All must have depth.
std::vector<RigidTransform> PosesFromDepth(const PinholeCamera& camera,
                                           const MinimalSample& sample);

/// The up to four camera_from_world from which the three points are seen in their pixels (Ke and
/// Roumeliotis, An Efficient Algebraic Solution to the Perspective-Three-Point Problem, CVPR 2017).
/// Depth is not used.
std::vector<RigidTransform> PosesFromPixels(const PinholeCamera& camera,
                                            const MinimalSample& sample);

}  // namespace ofm
