#include "ofm/sim/closed_way.h"

#include <algorithm>
#include <cmath>

#include "ofm/base/check.h"

namespace ofm {
namespace {

/// The mean of each point and those up to `reach` before and after it, around the round.
std::vector<Eigen::Vector2d> Smooth(const std::vector<Eigen::Vector2d>& points, int reach) {
  const int count = static_cast<int>(points.size());
  std::vector<Eigen::Vector2d> smooth(points.size());
  for (int i = 0; i < count; ++i) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int k = -reach; k <= reach; ++k) sum += points[((i + k) % count + count) % count];
    smooth[i] = sum / (2 * reach + 1);
  }
  return smooth;
}

}  // namespace

ClosedWay::ClosedWay(const std::vector<Eigen::Vector2d>& corners) {
  constexpr double kSpacing_m = 0.02, kReach_m = 0.4;
  OFM_CHECK(corners.size() >= 2);
  const auto corner = [&corners](std::size_t i) { return corners[i % corners.size()]; };
  for (std::size_t i = 0; i < corners.size(); ++i) length_m_ += (corner(i + 1) - corner(i)).norm();
  OFM_CHECK(length_m_ > 2 * kSpacing_m);
  const int count = static_cast<int>(std::ceil(length_m_ / kSpacing_m));
  const double spacing = length_m_ / count;
  double begin = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double length = (corner(i + 1) - corner(i)).norm();
    while (static_cast<int>(points_.size()) < count &&
           static_cast<double>(points_.size()) * spacing < begin + length) {
      const double ratio = (static_cast<double>(points_.size()) * spacing - begin) / length;
      points_.push_back(corner(i) + ratio * (corner(i + 1) - corner(i)));
    }
    begin += length;
  }
  const int reach = std::min(static_cast<int>(kReach_m / spacing), (count - 1) / 2);
  points_ = Smooth(Smooth(points_, reach), reach);
}

Eigen::Vector2d ClosedWay::At(double way_m) const {
  const double count = static_cast<double>(points_.size());
  const double rounds = way_m / length_m_;
  const double at = (rounds - std::floor(rounds)) * count;
  const std::size_t i = static_cast<std::size_t>(at) % points_.size();
  const double ratio = at - std::floor(at);
  return (1 - ratio) * points_[i] + ratio * points_[(i + 1) % points_.size()];
}

}  // namespace ofm
