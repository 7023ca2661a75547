// A smooth round through given corners.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ofm {

/// A closed way whose corners are rounded (the mean of the straight way over about a metre, taken
/// twice), so that it is a little inside of them.
class ClosedWay {
 public:
  /// At least two corners, not all the same.
  explicit ClosedWay(const std::vector<Eigen::Vector2d>& corners);

  /// The point `way_m` after the start, along the straight way; any number, as the way goes on and
  /// on.
  Eigen::Vector2d At(double way_m) const;
  /// Of one round, along the straight way.
  double length_m() const { return length_m_; }

 private:
  std::vector<Eigen::Vector2d> points_;  ///< evenly spaced
  double length_m_ = 0;
};

}  // namespace ofm
