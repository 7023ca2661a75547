#include "ofm/geometry/alignment.h"

#include <Eigen/SVD>
#include <algorithm>

#include "ofm/base/check.h"

namespace ofm {
namespace {

struct WeightedMean {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double weight = 0;
};

double WeightAt(std::span<const double> weights, std::size_t i) {
  return weights.empty() ? 1.0 : weights[i];
}

WeightedMean MeanOf(std::span<const Eigen::Vector3d> points, std::span<const double> weights) {
  WeightedMean result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.mean += WeightAt(weights, i) * points[i];
    result.weight += WeightAt(weights, i);
  }
  result.mean /= result.weight;
  return result;
}

}  // namespace

std::optional<RigidTransform> AlignRigid(std::span<const Eigen::Vector3d> source,
                                         std::span<const Eigen::Vector3d> target,
                                         std::span<const double> weights) {
  OFM_CHECK(source.size() == target.size());
  OFM_CHECK(weights.empty() || weights.size() == source.size());
  OFM_CHECK(std::none_of(weights.begin(), weights.end(), [](double w) { return w < 0; }));
  if (source.size() < 3) return {};
  const WeightedMean from = MeanOf(source, weights);
  const WeightedMean to = MeanOf(target, weights);
  if (!from.mean.allFinite() || !to.mean.allFinite()) return {};

  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < source.size(); ++i) {
    covariance.noalias() +=
        WeightAt(weights, i) * (target[i] - to.mean) * (source[i] - from.mean).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  // The rotation about the longest axis is known only where the points also spread beside it, by
  // more than the rounding of their coordinates.
  const Eigen::Vector3d& spread = svd.singularValues();
  const double rounding = 1e-26 * from.weight * from.mean.norm() * to.mean.norm();
  if (!(spread[1] > 1e-12 * spread[0] + rounding)) return {};

  Eigen::Vector3d sign(1, 1, 1);
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) sign.z() = -1;
  const Eigen::Matrix3d rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  return RigidTransform(rotation, to.mean - rotation * from.mean);
}

}  // namespace ofm
