// Absolute trajectory error (J. Sturm et al., A Benchmark for the Evaluation of RGB-D SLAM Systems,
// IROS 2012, section V-C).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ofm/eval/statistics.h"
#include "ofm/geometry/trajectory.h"
#include "ofm/io/association.h"

namespace ofm {

/// How far an estimated position is from the truth after alignment.
struct PositionError {
  std::int64_t stamp_ns = 0;  ///< of the estimated pose
  double error_m = 0;
};

struct AteResult {
  ErrorStatistics translation_m;       ///< its count is the number of pairs compared
  std::vector<PositionError> errors;   ///< in order of time
  RigidTransform truth_from_estimate;  ///< from the estimate's world to the ground truth's
  Trajectory aligned_estimate;         ///< the whole estimate in the ground truth's world
};

/// Associates both trajectories within `max_difference_s` (AssociateStamps), moves the estimate
/// onto the ground truth by the rigid transform without scale that is best in the least-squares
/// sense (S. Umeyama, PAMI 1991), or by `truth_from_estimate` where that is known, and measures the
/// distances that stay. Throws Error where fewer than two poses have a partner.
AteResult ComputeAte(const Trajectory& estimate, const Trajectory& groundtruth,
                     double max_difference_s = kMaxStampDifference_s,
                     const std::optional<RigidTransform>& truth_from_estimate = {});

/// truth_from_estimate from whole poses, for what the cameras saw: it also brings points one metre
/// along the cameras' axes together. ComputeAte's is from positions alone, as the benchmark wants,
/// and says little of the rotation about a short or straight path. Pairs and errors as there.
RigidTransform AlignPoses(const Trajectory& estimate, const Trajectory& groundtruth,
                          double max_difference_s = kMaxStampDifference_s);

}  // namespace ofm
