// The camera's pose from matches of which many are wrong, without a first guess.
#pragma once

#include <optional>
#include <span>

#include "ofm/base/random.h"
#include "ofm/estimation/pose_optimizer.h"

namespace ofm {

struct PnpOptions {
  int iterations = 300;      ///< of RANSAC, at most
  double confidence = 0.99;  ///< at which it ends early
  int min_inliers = 15;
  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("iterations", self.iterations, "iterations of RANSAC at most", Range{1, 100000});
    visit("confidence", self.confidence, "confidence at which RANSAC ends early",
          Range{0.5, 0.999999});
    visit("min_inliers", self.min_inliers, "fewer inliers are no pose", Range{4, 10000});
  }
};

/// RANSAC over minimal sets (three points with depth: closed-form alignment; without depth: P3P),
/// inliers by the chi-square gates of `seen`, then OptimizePose on them. Empty where no pose has
/// min_inliers.
std::optional<PoseEstimate> EstimatePoseRansac(const PinholeCamera& camera,
                                               std::span<const PoseObservation> matches,
                                               const PnpOptions& options, RandomEngine& engine);

}  // namespace ofm
