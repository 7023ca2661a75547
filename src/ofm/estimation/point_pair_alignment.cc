#include "ofm/estimation/point_pair_alignment.h"

#include <algorithm>
#include <array>

#include "ofm/base/check.h"
#include "ofm/estimation/reprojection.h"
#include "ofm/geometry/alignment.h"

namespace ofm {
namespace {

/// A pose from three noisy pairs misses many that are right: for a refinement the gates are this
/// much wider.
constexpr double kWideGateScale = 9;
constexpr int kRefinements = 3;

bool IsInlier(const PinholeCamera& camera, const RigidTransform& target_from_source,
              const PointPair& pair, double gate_scale) {
  const auto agrees = [&](const Eigen::Vector3d& point, const PointObservation& seen) {
    return ReprojectionChiSquare(camera, point, seen) <= gate_scale * ChiSquareGate(seen);
  };
  return agrees(target_from_source * pair.point_in_source, pair.seen_in_target) &&
         agrees(target_from_source.Inverse() * pair.point_in_target, pair.seen_in_source);
}

PairAlignment Judge(const PinholeCamera& camera, const RigidTransform& target_from_source,
                    std::span<const PointPair> pairs, double gate_scale = 1) {
  PairAlignment alignment{target_from_source, {}, 0};
  alignment.inlier.reserve(pairs.size());
  for (const PointPair& pair : pairs) {
    alignment.inlier.push_back(IsInlier(camera, target_from_source, pair, gate_scale));
    alignment.inlier_count += alignment.inlier.back();
  }
  return alignment;
}

/// Least squares over the pairs that `of` holds for inliers. Far points are measured worse.
std::optional<RigidTransform> AlignInliers(std::span<const PointPair> pairs,
                                           const PairAlignment& of) {
  std::vector<Eigen::Vector3d> source, target;
  std::vector<double> weights;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!of.inlier[i]) continue;
    source.push_back(pairs[i].point_in_source);
    target.push_back(pairs[i].point_in_target);
    weights.push_back(1 / (source.back().squaredNorm() + target.back().squaredNorm()));
  }
  return AlignRigid(source, target, weights);
}

/// Local optimisation (Chum, Matas and Kittler 2003): from all pairs that roughly agree.
PairAlignment Refine(const PinholeCamera& camera, std::span<const PointPair> pairs,
                     PairAlignment best) {
  for (int i = 0; i < kRefinements; ++i) {
    const PairAlignment near = Judge(camera, best.target_from_source, pairs, kWideGateScale);
    const std::optional<RigidTransform> pose = AlignInliers(pairs, i == 0 ? near : best);
    if (!pose) break;
    PairAlignment refined = Judge(camera, *pose, pairs);
    if (refined.inlier_count < best.inlier_count) break;
    best = std::move(refined);
  }
  return best;
}

std::optional<RigidTransform> AlignSample(std::span<const PointPair> pairs, RandomEngine& engine) {
  const auto count = static_cast<std::uint32_t>(pairs.size());
  const std::uint32_t a = UniformIndex(engine, count);
  std::uint32_t b = a, c = a;
  while (b == a) b = UniformIndex(engine, count);
  while (c == a || c == b) c = UniformIndex(engine, count);
  const std::array source = {pairs[a].point_in_source, pairs[b].point_in_source,
                             pairs[c].point_in_source};
  const std::array target = {pairs[a].point_in_target, pairs[b].point_in_target,
                             pairs[c].point_in_target};
  return AlignRigid(source, target);
}

}  // namespace

std::optional<PairAlignment> AlignPairsRansac(const PinholeCamera& camera,
                                              std::span<const PointPair> pairs, int min_inliers,
                                              const RansacLimits& limits, RandomEngine& engine) {
  OFM_CHECK(min_inliers >= 3 && limits.iterations >= 1);
  OFM_CHECK(limits.confidence > 0 && limits.confidence < 1);
  if (static_cast<int>(pairs.size()) < min_inliers) return {};
  PairAlignment best;
  int needed = limits.iterations;
  for (int i = 0; i < needed; ++i) {
    const std::optional<RigidTransform> pose = AlignSample(pairs, engine);
    if (!pose) continue;
    PairAlignment alignment = Judge(camera, *pose, pairs);
    if (alignment.inlier_count <= best.inlier_count) continue;
    best = Refine(camera, pairs, std::move(alignment));
    const double share = static_cast<double>(best.inlier_count) / static_cast<double>(pairs.size());
    needed = RansacIterations(share, limits);
  }
  if (best.inlier_count < min_inliers) return {};
  return best;
}

}  // namespace ofm
