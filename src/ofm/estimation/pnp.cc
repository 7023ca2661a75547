#include "ofm/estimation/pnp.h"

#include <algorithm>

#include "ofm/base/check.h"
#include "ofm/estimation/minimal_pose.h"
#include "ofm/estimation/ransac.h"
#include "ofm/estimation/reprojection.h"

namespace ofm {
namespace {

/// A pose from three noisy matches misses many that are right: for a refinement the gates are
/// this much wider.
constexpr double kWideGateScale = 16;

struct Hypothesis {
  RigidTransform camera_from_world;
  double score = 0;  ///< sum of 1 - chi2 / gate over the inliers (Torr and Zisserman's MSAC)
  int inliers = 0;
};

class PoseRansac {
 public:
  PoseRansac(const PinholeCamera& camera, std::span<const PoseObservation> matches,
             const PnpOptions& options)
      : camera_(camera), matches_(matches), options_(options) {
    for (std::size_t i = 0; i < matches.size(); ++i) {
      OFM_CHECK(IsValid(matches[i].seen) && matches[i].point_in_world.allFinite());
      if (HasDepth(matches[i].seen)) candidates_.push_back(i);
    }
    // Depth makes one pose of a sample; but few depths are no picture of all matches.
    use_depth_ = static_cast<int>(candidates_.size()) >= options.min_inliers;
    if (use_depth_) return;
    candidates_.resize(matches.size());
    for (std::size_t i = 0; i < matches.size(); ++i) candidates_[i] = i;
  }

  /// The best pose found; that of a minimal set, refined.
  Hypothesis Run(RandomEngine& engine) {
    Hypothesis best;
    int needed = options_.iterations;
    for (int i = 0; i < needed; ++i) {
      const MinimalSample sample = Draw(engine);
      for (const RigidTransform& pose :
           use_depth_ ? PosesFromDepth(camera_, sample) : PosesFromPixels(camera_, sample)) {
        const Hypothesis hypothesis = Score(pose);
        if (hypothesis.score <= best.score) continue;
        best = hypothesis;
        const Hypothesis refined = Score(Refine(pose));
        if (refined.score > best.score) best = refined;
        const double share = static_cast<double>(best.inliers) / matches_.size();
        needed = RansacIterations(share, {options_.iterations, options_.confidence});
      }
    }
    return best;
  }

  /// Indices of the matches within their gates times `gate_scale`.
  std::vector<std::size_t> Inliers(const RigidTransform& pose, double gate_scale) const {
    std::vector<std::size_t> inliers;
    for (std::size_t i = 0; i < matches_.size(); ++i) {
      if (ChiSquareOverGate(pose, matches_[i]) <= gate_scale) inliers.push_back(i);
    }
    return inliers;
  }

  std::vector<PoseObservation> Select(const std::vector<std::size_t>& indices) const {
    std::vector<PoseObservation> selected;
    for (const std::size_t i : indices) selected.push_back(matches_[i]);
    return selected;
  }

 private:
  double ChiSquareOverGate(const RigidTransform& pose, const PoseObservation& match) const {
    const Eigen::Vector3d point = pose * match.point_in_world;
    return ReprojectionChiSquare(camera_, point, match.seen) / ChiSquareGate(match.seen);
  }

  MinimalSample Draw(RandomEngine& engine) const {
    const auto count = static_cast<std::uint32_t>(candidates_.size());
    const std::uint32_t a = UniformIndex(engine, count);
    std::uint32_t b = a, c = a;
    while (b == a) b = UniformIndex(engine, count);
    while (c == a || c == b) c = UniformIndex(engine, count);
    return {matches_[candidates_[a]], matches_[candidates_[b]], matches_[candidates_[c]]};
  }

  Hypothesis Score(const RigidTransform& pose) const {
    Hypothesis hypothesis{pose};
    for (const PoseObservation& match : matches_) {
      const double ratio = ChiSquareOverGate(pose, match);
      if (ratio > 1) continue;
      hypothesis.score += 1 - ratio;
      ++hypothesis.inliers;
    }
    return hypothesis;
  }

  /// Local optimisation (Chum, Matas and Kittler 2003): a pose from all that roughly agree.
  RigidTransform Refine(const RigidTransform& pose) const {
    const std::vector<PoseObservation> near = Select(Inliers(pose, kWideGateScale));
    return OptimizePose(camera_, pose, near, {.rounds = 2, .iterations = 5}).camera_from_world;
  }

  const PinholeCamera& camera_;
  std::span<const PoseObservation> matches_;
  const PnpOptions& options_;
  std::vector<std::size_t> candidates_;  ///< the matches that samples are drawn from
  bool use_depth_ = false;
};

}  // namespace

std::optional<PoseEstimate> EstimatePoseRansac(const PinholeCamera& camera,
                                               std::span<const PoseObservation> matches,
                                               const PnpOptions& options, RandomEngine& engine) {
  OFM_CHECK(options.min_inliers >= 3 && options.iterations >= 1);
  OFM_CHECK(options.confidence > 0 && options.confidence < 1);
  if (static_cast<int>(matches.size()) < options.min_inliers) return {};
  PoseRansac ransac(camera, matches, options);
  const Hypothesis best = ransac.Run(engine);
  if (best.inliers < 3) return {};

  const std::vector<std::size_t> near = ransac.Inliers(best.camera_from_world, kWideGateScale);
  PoseEstimate estimate = OptimizePose(camera, best.camera_from_world, ransac.Select(near), {});
  if (!estimate.converged || estimate.inlier_count < options.min_inliers) return {};
  std::vector<char> inlier(matches.size(), 0);
  for (std::size_t i = 0; i < near.size(); ++i) inlier[near[i]] = estimate.inlier[i];
  estimate.inlier = std::move(inlier);
  return estimate;
}

}  // namespace ofm
