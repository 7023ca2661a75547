#include "ofm/eval/ate.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "ofm/base/error.h"
#include "ofm/base/time.h"
#include "ofm/eval/stamps.h"

namespace ofm {
namespace {

/// Pairs with the ground truth as `first`, for the tool breaks ties in its favour.
std::vector<StampPair> Associate(const Trajectory& estimate, const Trajectory& groundtruth,
                                 double max_difference_s) {
  const auto pairs = AssociateStamps(StampsOf(groundtruth), StampsOf(estimate),
                                     SecondsToNanoseconds(max_difference_s));
  if (pairs.size() < 2) {
    throw Error(
        fmt::format("{} of {} estimated poses have one of {} true poses within {} s, but 2 "
                    "are needed; are both files of one recording?",
                    pairs.size(), estimate.size(), groundtruth.size(), max_difference_s));
  }
  return pairs;
}

RigidTransform Align(const Eigen::Matrix3Xd& source, const Eigen::Matrix3Xd& target) {
  const Eigen::Matrix4d target_from_source = Eigen::umeyama(source, target, false);
  return {Eigen::Matrix3d(target_from_source.topLeftCorner<3, 3>()),
          Eigen::Vector3d(target_from_source.topRightCorner<3, 1>())};
}

}  // namespace

AteResult ComputeAte(const Trajectory& estimate, const Trajectory& groundtruth,
                     double max_difference_s,
                     const std::optional<RigidTransform>& truth_from_estimate) {
  const auto pairs = Associate(estimate, groundtruth, max_difference_s);
  const auto count = static_cast<Eigen::Index>(pairs.size());
  Eigen::Matrix3Xd estimated(3, count), truth(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto [true_index, estimated_index] = pairs[static_cast<std::size_t>(i)];
    estimated.col(i) = estimate[estimated_index].world_from_camera.translation();
    truth.col(i) = groundtruth[true_index].world_from_camera.translation();
  }

  AteResult result;
  result.truth_from_estimate = truth_from_estimate ? *truth_from_estimate : Align(estimated, truth);
  std::vector<double> errors_m;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d aligned = result.truth_from_estimate * Eigen::Vector3d(estimated.col(i));
    errors_m.push_back((aligned - truth.col(i)).norm());
    const std::size_t index = pairs[static_cast<std::size_t>(i)].second;
    result.errors.push_back({estimate[index].stamp_ns, errors_m.back()});
  }
  result.translation_m = ComputeStatistics(errors_m);
  for (const auto& [stamp_ns, pose] : estimate) {
    result.aligned_estimate.push_back({stamp_ns, result.truth_from_estimate * pose});
  }
  return result;
}

RigidTransform AlignPoses(const Trajectory& estimate, const Trajectory& groundtruth,
                          double max_difference_s) {
  const auto pairs = Associate(estimate, groundtruth, max_difference_s);
  Eigen::Matrix3Xd estimated(3, 4 * pairs.size()), truth(3, 4 * pairs.size());
  Eigen::Index column = 0;
  for (const auto& [true_index, estimated_index] : pairs) {
    for (const Eigen::Vector3d& in_camera : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0),
                                             Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1)}) {
      estimated.col(column) = estimate[estimated_index].world_from_camera * in_camera;
      truth.col(column++) = groundtruth[true_index].world_from_camera * in_camera;
    }
  }
  return Align(estimated, truth);
}

}  // namespace ofm
