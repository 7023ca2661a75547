// Where people may walk: places, and which are joined by a free straight way.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace ofm {

struct FloorGraph {
  std::vector<Eigen::Vector2d> places;  ///< (x, y) in the world [m]
  std::vector<std::pair<int, int>> ways;

  /// The place nearest to `point`; there must be one.
  int Nearest(const Eigen::Vector2d& point) const;
  /// Places of the shortest way (Dijkstra), without `from`; empty where `to` cannot be reached or
  /// is `from`.
  std::vector<int> ShortestWay(int from, int to) const;
};

}  // namespace ofm
