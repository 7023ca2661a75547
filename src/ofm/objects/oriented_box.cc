#include "ofm/objects/oriented_box.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ofm {
namespace {

struct Interval {
  double min = 0, max = 0;
  double Size() const { return max - min; }
  double Middle() const { return (min + max) / 2; }
};

/// What is left of the values without the outermost ones; reorders them.
Interval TrimmedInterval(std::vector<double>& values, double trim_share) {
  const auto last = static_cast<double>(values.size() - 1);
  const auto at = [&](double rank) {
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::lround(rank));
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  return {at(trim_share * last), at((1 - trim_share) * last)};
}

Interval Extent(std::span<const Eigen::Vector3f> points, const Eigen::Vector3d& axis,
                double trim_share) {
  std::vector<double> along;
  along.reserve(points.size());
  for (const Eigen::Vector3f& point : points) along.push_back(point.cast<double>().dot(axis));
  return TrimmedInterval(along, trim_share);
}

/// The box's sides in the plane across up.
struct BaseRectangle {
  Eigen::Vector3d x, y;
  Interval along_x, along_y;

  /// Of a thin object, as a screen, the length must matter too: no side counts as under 1 cm.
  double Area() const { return (along_x.Size() + .01) * (along_y.Size() + .01); }
};

BaseRectangle RectangleAt(std::span<const Eigen::Vector3f> points, const Eigen::Vector3d& up,
                          double yaw_rad, double trim_share) {
  const Eigen::Vector3d x = Eigen::AngleAxisd(yaw_rad, up) * up.unitOrthogonal();
  const Eigen::Vector3d y = up.cross(x);
  return {x, y, Extent(points, x, trim_share), Extent(points, y, trim_share)};
}

}  // namespace

OrientedBox FitOrientedBox(std::span<const Eigen::Vector3f> points_in_world,
                           const Eigen::Vector3d& up, double trim_share) {
  if (points_in_world.empty()) return {};
  constexpr int kQuarterTurn_deg = 90;  // after which the box is the same
  BaseRectangle base = RectangleAt(points_in_world, up, 0, trim_share);
  for (int yaw_deg = 1; yaw_deg < kQuarterTurn_deg; ++yaw_deg) {
    BaseRectangle turned = RectangleAt(points_in_world, up, yaw_deg * M_PI / 180, trim_share);
    if (turned.Area() < base.Area()) base = turned;
  }
  if (base.along_y.Size() > base.along_x.Size()) {  // stays right-handed
    base = {base.y, -base.x, base.along_y, {-base.along_x.max, -base.along_x.min}};
  }
  const Interval along_up = Extent(points_in_world, up, trim_share);
  Eigen::Matrix3d axes;
  axes << base.x, base.y, up;
  OrientedBox box;
  box.center_in_world =
      base.x * base.along_x.Middle() + base.y * base.along_y.Middle() + up * along_up.Middle();
  box.world_from_box = Eigen::Quaterniond(axes).normalized();
  box.size_m = {base.along_x.Size(), base.along_y.Size(), along_up.Size()};
  return box;
}

}  // namespace ofm
