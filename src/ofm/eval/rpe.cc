#include "ofm/eval/rpe.h"

#include <algorithm>
#include <numbers>
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

/// The errors of the pairs so far.
class Errors {
 public:
  explicit Errors(const std::vector<PosePair>& poses) : poses_(poses) {}

  void Add(std::size_t i, std::size_t j) {
    const PosePair &a = poses_[i], &b = poses_[j];
    if (!a.has_truth || !b.has_truth) return;
    const RigidTransform error =
        (a.estimate.Inverse() * b.estimate) * (b.truth.Inverse() * a.truth);
    translations_m_.push_back(error.translation().norm());
    rotations_deg_.push_back(error.RotationAngle() * 180 / std::numbers::pi);
  }

  RpeResult Summarize() const {
    return {ComputeStatistics(translations_m_), ComputeStatistics(rotations_deg_)};
  }

 private:
  const std::vector<PosePair>& poses_;
  std::vector<double> translations_m_, rotations_deg_;
};

void AddFixedDelta(const std::vector<std::int64_t>& stamps, double delta_s, Errors& errors) {
  const std::int64_t delta_ns = SecondsToNanoseconds(delta_s);
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const std::size_t j = NearestStamp(stamps, stamps[i] + delta_ns);
    if (j != stamps.size() - 1) errors.Add(i, j);
  }
}

void AddAll(std::size_t count, const RpeOptions& options, Errors& errors) {
  if (options.max_pairs == 0 || count * count <= options.max_pairs) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) errors.Add(i, j);
    }
    return;
  }
  RandomEngine engine = MakeRandomEngine(options.seed, 0);
  const auto bound = static_cast<std::uint32_t>(count);
  for (std::size_t k = 0; k < options.max_pairs; ++k) {
    const std::uint32_t i = UniformIndex(engine, bound), j = UniformIndex(engine, bound);
    errors.Add(i, j);
  }
}

}  // namespace

RpeResult ComputeRpe(const Trajectory& estimate, const Trajectory& groundtruth,
                     const RpeOptions& options) {
  OFM_CHECK(options.delta_s > 0);
  if (groundtruth.size() < 2) throw Error("the ground truth holds fewer than 2 poses");
  const std::vector<PosePair> poses = FindTruth(estimate, groundtruth);
  Errors errors(poses);
  switch (options.pairs) {
    case RpePairs::kConsecutive:
      for (std::size_t i = 0; i + 2 < poses.size(); ++i) errors.Add(i, i + 1);
      break;
    case RpePairs::kFixedDelta:
      AddFixedDelta(StampsOf(estimate), options.delta_s, errors);
      break;
    case RpePairs::kAll:
      AddAll(poses.size(), options, errors);
      break;
  }
  return errors.Summarize();
}

}  // namespace ofm
