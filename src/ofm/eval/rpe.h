// Relative pose error (J. Sturm et al., A Benchmark for the Evaluation of RGB-D SLAM Systems, IROS
// 2012, section V-B).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ofm/eval/statistics.h"
#include "ofm/geometry/trajectory.h"

namespace ofm {

/// Which pairs of estimated poses are compared. The figures of different kinds cannot be compared
/// with one another.
enum class RpePairs {
  kConsecutive,  ///< each pose and the next: drift per frame
  kFixedDelta,   ///< each pose and the one nearest to a fixed time after it
  kAll,          ///< every pose and every pose, itself included
};

struct RpeOptions {
  RpePairs pairs = RpePairs::kFixedDelta;
  double delta_s = 1;               ///< for kFixedDelta
  std::size_t max_pairs = 4000000;  ///< for kAll: more are replaced by as many drawn pairs; 0 = all
  std::uint64_t seed = 0;           ///< of that draw
};

struct RpeResult {
  ErrorStatistics translation_m;  ///< its count is the number of pairs compared
  ErrorStatistics rotation_deg;
};

/// With P the estimated and Q the true poses at times i and j, the error of a pair is
/// E = (P_j^-1 P_i)^-1 (Q_j^-1 Q_i): the length of its translation and the angle of its rotation.
/// As the benchmark's tool does, the truth is the nearest pose in time, a pair is left out where
/// one is farther off than twice the median interval of the ground truth, and for kConsecutive and
/// kFixedDelta also where j is the last pose. Where no pair is left the counts are 0. Throws Error
/// where the ground truth holds fewer than two poses.
RpeResult ComputeRpe(const Trajectory& estimate, const Trajectory& groundtruth,
                     const RpeOptions& options = {});

/// The error of one pair.
struct MotionError {
  std::int64_t stamp_ns = 0;  ///< of the pair's first pose
  double translation_m = 0, rotation_deg = 0;
};

/// The errors that ComputeRpe is of, in order of time; `options.pairs` is not kAll, which has no
/// such order.
std::vector<MotionError> ComputeMotionErrors(const Trajectory& estimate,
                                             const Trajectory& groundtruth,
                                             const RpeOptions& options = {});

}  // namespace ofm
