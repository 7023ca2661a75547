#include "ofm/sim/floor_graph.h"

#include <algorithm>
#include <limits>

#include "ofm/base/check.h"

namespace ofm {

int FloorGraph::Nearest(const Eigen::Vector2d& point) const {
  OFM_CHECK(!places.empty());
  const auto nearest = std::min_element(
      places.begin(), places.end(), [&point](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
        return (a - point).squaredNorm() < (b - point).squaredNorm();
      });
  return static_cast<int>(nearest - places.begin());
}

std::vector<int> FloorGraph::ShortestWay(int from, int to) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const int count = static_cast<int>(places.size());
  std::vector<double> distance(count, kFar);
  std::vector<int> before(count, -1);
  std::vector<char> done(count, 0);
  distance[from] = 0;
  for (int step = 0; step < count; ++step) {
    int nearest = -1;
    for (int i = 0; i < count; ++i) {
      if (!done[i] && distance[i] < kFar && (nearest < 0 || distance[i] < distance[nearest])) {
        nearest = i;
      }
    }
    if (nearest < 0 || nearest == to) break;
    done[nearest] = 1;
    for (const auto& [a, b] : ways) {
      if (a != nearest && b != nearest) continue;
      const int other = a == nearest ? b : a;
      const double length = distance[nearest] + (places[a] - places[b]).norm();
      if (length >= distance[other]) continue;
      distance[other] = length;
      before[other] = nearest;
    }
  }
  std::vector<int> way;
  for (int at = to; at != from && at >= 0; at = before[at]) way.insert(way.begin(), at);
  if (!way.empty() && before[way.front()] != from) way.clear();
  return way;
}

}  // namespace ofm
