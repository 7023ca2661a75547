#include "ofm/eval/rpe.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "ofm/base/check.h"
#include "ofm/base/error.h"
#include "ofm/base/random.h"
#include "ofm/base/time.h"
#include "ofm/eval/stamps.h"
#include "ofm/io/association.h"

namespace ofm {
namespace {

/// An estimated pose with the truth at its time.
struct PosePair {
  RigidTransform estimate, truth;
  bool has_truth = false;
};

double MedianInterval(const std::vector<std::int64_t>& stamps) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    intervals.push_back(static_cast<double>(stamps[i] - stamps[i - 1]));
  }
  return ComputeStatistics(intervals).median;
}

std::vector<PosePair> FindTruth(const Trajectory& estimate, const Trajectory& groundtruth) {
  const std::vector<std::int64_t> stamps = StampsOf(groundtruth);
  const double max_difference_ns = 2 * MedianInterval(stamps);
  std::vector<PosePair> poses;
  poses.reserve(estimate.size());
  for (const auto& [stamp_ns, world_from_camera] : estimate) {
    const std::size_t nearest = NearestStamp(stamps, stamp_ns);
    const double difference_ns = static_cast<double>(std::abs(stamps[nearest] - stamp_ns));
    poses.push_back({world_from_camera, groundtruth[nearest].world_from_camera,
                     difference_ns <= max_difference_ns});
  }
  return poses;
}

/// The error of the motion from one pose to the other; empty where one has no truth.
std::optional<RigidTransform> ErrorOfPair(const PosePair& a, const PosePair& b) {
  if (!a.has_truth || !b.has_truth) return {};
  return (a.estimate.Inverse() * b.estimate) * (b.truth.Inverse() * a.truth);
}

double Degrees(const RigidTransform& error) {
  return error.RotationAngle() * 180 / std::numbers::pi;
}

template <class Visit>
void ForPairsOfFixedDelta(const std::vector<std::int64_t>& stamps, double delta_s, Visit&& visit) {
  const std::int64_t delta_ns = SecondsToNanoseconds(delta_s);
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const std::size_t j = NearestStamp(stamps, stamps[i] + delta_ns);
    if (j != stamps.size() - 1) visit(i, j);
  }
}

template <class Visit>
void ForAllPairs(std::size_t count, const RpeOptions& options, Visit&& visit) {
  if (options.max_pairs == 0 || count * count <= options.max_pairs) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) visit(i, j);
    }
    return;
  }
  RandomEngine engine = MakeRandomEngine(options.seed, 0);
  const auto bound = static_cast<std::uint32_t>(count);
  for (std::size_t k = 0; k < options.max_pairs; ++k) {
    const std::uint32_t i = UniformIndex(engine, bound), j = UniformIndex(engine, bound);
    visit(i, j);
  }
}

/// Calls `visit` with the indices of both poses of every pair.
template <class Visit>
void ForPairs(const Trajectory& estimate, const RpeOptions& options, Visit&& visit) {
  switch (options.pairs) {
    case RpePairs::kConsecutive:
      for (std::size_t i = 0; i + 2 < estimate.size(); ++i) visit(i, i + 1);
      break;
    case RpePairs::kFixedDelta:
      ForPairsOfFixedDelta(StampsOf(estimate), options.delta_s, visit);
      break;
    case RpePairs::kAll:
      ForAllPairs(estimate.size(), options, visit);
      break;
  }
}

void Require(const Trajectory& groundtruth, const RpeOptions& options) {
  OFM_CHECK(options.delta_s > 0);
  if (groundtruth.size() < 2) throw Error("the ground truth holds fewer than 2 poses");
}

}  // namespace

RpeResult ComputeRpe(const Trajectory& estimate, const Trajectory& groundtruth,
                     const RpeOptions& options) {
  Require(groundtruth, options);
  const std::vector<PosePair> poses = FindTruth(estimate, groundtruth);
  std::vector<double> translations_m, rotations_deg;
  ForPairs(estimate, options, [&](std::size_t i, std::size_t j) {
    const auto error = ErrorOfPair(poses[i], poses[j]);
    if (!error) return;
    translations_m.push_back(error->translation().norm());
    rotations_deg.push_back(Degrees(*error));
  });
  return {ComputeStatistics(translations_m), ComputeStatistics(rotations_deg)};
}

std::vector<MotionError> ComputeMotionErrors(const Trajectory& estimate,
                                             const Trajectory& groundtruth,
                                             const RpeOptions& options) {
  OFM_CHECK(options.pairs != RpePairs::kAll);
  Require(groundtruth, options);
  const std::vector<PosePair> poses = FindTruth(estimate, groundtruth);
  std::vector<MotionError> errors;
  ForPairs(estimate, options, [&](std::size_t i, std::size_t j) {
    const auto error = ErrorOfPair(poses[i], poses[j]);
    if (!error) return;
    errors.push_back({estimate[i].stamp_ns, error->translation().norm(), Degrees(*error)});
  });
  return errors;
}

}  // namespace ofm
