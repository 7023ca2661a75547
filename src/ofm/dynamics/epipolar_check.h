// Points that the camera's own motion does not explain (OFM-SLAM, Algorithm 1).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "ofm/dynamics/dynamics_options.h"

namespace ofm {

/// Ideal pixels (without distortion) of the same points in two images; of equal length.
struct PointPairs {
  std::vector<Eigen::Vector2d> first;   ///< [px]
  std::vector<Eigen::Vector2d> second;  ///< [px]

  std::size_t size() const { return first.size(); }
  void Add(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    first.push_back(a);
    second.push_back(b);
  }
};

/// A fundamental matrix and its support.
struct FundamentalFit {
  Eigen::Matrix3d second_from_first;  ///< F: second^T F first = 0
  std::size_t inliers = 0;            ///< pairs within the RANSAC threshold
};

/// The matrix most pairs agree with: RANSAC, then the normalised eight-point method (Hartley 1997)
/// on its inliers. The same pairs always give the same matrix. Empty where there are fewer than
/// min_points pairs, the geometry is degenerate, or less than min_inlier_share agree.
std::optional<FundamentalFit> FitFundamental(const PointPairs& pairs,
                                             const EpipolarOptions& options);

/// Distance [px] of `second` from the epipolar line of `first`: |second^T F first| / sqrt(X^2 +
/// Y^2) with F first = (X, Y, Z). 0 where the line is undefined (`first` is the epipole).
double EpipolarDistance(const Eigen::Matrix3d& fundamental, const Eigen::Vector2d& first,
                        const Eigen::Vector2d& second);

}  // namespace ofm
