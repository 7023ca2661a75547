// What the searches by random samples share.
#pragma once

#include <cmath>

namespace ofm {

/// When a RANSAC ends.
struct RansacLimits {
  int iterations = 300;      ///< at most
  double confidence = 0.99;  ///< that one sample was all right; at it the search ends early
};

/// Iterations after which a sample of three right matches was drawn with the confidence asked for
/// (Fischler and Bolles 1981).
inline int RansacIterations(double inlier_share, const RansacLimits& limits) {
  const double all_right = inlier_share * inlier_share * inlier_share;
  if (all_right >= limits.confidence) return 1;
  const double needed = std::ceil(std::log(1 - limits.confidence) / std::log1p(-all_right));
  return needed < limits.iterations ? static_cast<int>(needed) : limits.iterations;
}

}  // namespace ofm
