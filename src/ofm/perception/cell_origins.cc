#include "ofm/perception/cell_origins.h"

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "ofm/base/check.h"

namespace ofm {
namespace {

const cv::Vec2f kUnknown(kNoOrigin, kNoOrigin);

/// By how much the depths of one surface may differ from frame to frame, and from cell to cell.
constexpr float kStep_m = 0.1F, kStepPerMetre = 0.03F;
/// So many cells deep is filled what has no origin of its own.
constexpr int kFilledRings = 2;

bool IsKnown(const cv::Vec2f& origin) { return origin[0] > kNoOrigin; }

/// How different two depths are, in units of what one surface may have; 1 where one is unknown.
float Difference(float a_m, float b_m) {
  if (a_m <= 0 || b_m <= 0) return 1;
  return std::abs(a_m - b_m) / (kStep_m + kStepPerMetre * a_m);
}

struct LastFrame {
  const cv::Mat& origins;
  const cv::Mat& depth_m;
};

/// The origin of a cell of this depth if it goes on the one at (x, y), `offset` away.
std::optional<cv::Vec2f> OriginOver(int x, int y, const cv::Vec2f& offset, float depth_m,
                                    const LastFrame& last) {
  if (x < 0 || y < 0 || x >= last.depth_m.cols || y >= last.depth_m.rows) return {};
  if (Difference(depth_m, last.depth_m.at<float>(y, x)) > 1) return {};
  const cv::Vec2f& known = last.origins.at<cv::Vec2f>(y, x);
  if (!IsKnown(known)) return {};
  return known + offset;
}

/// The origin of a cell that was at `place` (column, row) in the last frame: over the nearest of
/// the four cells around that has one and a like depth.
cv::Vec2f OriginOf(const cv::Vec2f& place, float depth_m, const LastFrame& last) {
  const float left = std::floor(place[0]), top = std::floor(place[1]);
  const std::array<float, 2> dx{place[0] - left, place[0] - left - 1};
  const std::array<float, 2> dy{place[1] - top, place[1] - top - 1};
  const auto over = [&](int right, int below) {
    return OriginOver(static_cast<int>(left) + right, static_cast<int>(top) + below,
                      {dx[right], dy[below]}, depth_m, last);
  };
  const int near_x = dx[0] > 0.5F ? 1 : 0, near_y = dy[0] > 0.5F ? 1 : 0;
  if (const auto origin = over(near_x, near_y)) return *origin;
  cv::Vec2f nearest = kUnknown;
  float least = 2;
  for (const int below : {0, 1}) {
    for (const int right : {0, 1}) {
      const float cost = std::abs(dx[right]) + std::abs(dy[below]);
      if (cost >= least || dx[right] <= -1 || dy[below] <= -1) continue;
      const auto origin = over(right, below);
      if (!origin) continue;
      least = cost;
      nearest = *origin;
    }
  }
  return nearest;
}

/// The neighbour of `cell` that has an origin and the most similar depth, if that is like its own.
std::optional<cv::Point> FindKin(cv::Point cell, const cv::Mat& depth_m, const cv::Mat& origins) {
  constexpr std::array<std::array<int, 2>, 4> kNeighbours{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  std::optional<cv::Point> kin;
  float least = 1;
  for (const auto& [dx, dy] : kNeighbours) {
    const cv::Point other(cell.x + dx, cell.y + dy);
    if (other.x < 0 || other.y < 0 || other.x >= origins.cols || other.y >= origins.rows) continue;
    const float difference = Difference(depth_m.at<float>(cell), depth_m.at<float>(other));
    if (difference >= least || !IsKnown(origins.at<cv::Vec2f>(other))) continue;
    least = difference;
    kin = other;
  }
  return kin;
}

/// Cells without an origin go the way of a neighbour of like depth, where that leads to this depth.
void FillRing(const LastFrame& last, const cv::Mat& depth_m, cv::Mat& places, cv::Mat& origins) {
  struct Filled {
    cv::Point cell;
    cv::Vec2f place, origin;
  };
  std::vector<Filled> ring;
  for (int y = 0; y < origins.rows; ++y) {
    const auto* row = origins.ptr<cv::Vec2f>(y);
    const auto* depth = depth_m.ptr<float>(y);
    for (int x = 0; x < origins.cols; ++x) {
      if (IsKnown(row[x]) || depth[x] <= 0) continue;
      const cv::Point cell(x, y);
      const auto kin = FindKin(cell, depth_m, origins);
      if (!kin) continue;
      const cv::Vec2f offset(static_cast<float>(x - kin->x), static_cast<float>(y - kin->y));
      const cv::Vec2f place = places.at<cv::Vec2f>(*kin) + offset;
      ring.push_back({cell, place, OriginOf(place, depth[x], last)});
    }
  }
  for (const Filled& filled : ring) {
    places.at<cv::Vec2f>(filled.cell) = filled.place;
    origins.at<cv::Vec2f>(filled.cell) = filled.origin;
  }
}

}  // namespace

cv::Mat OwnOrigins(cv::Size size) {
  cv::Mat origins(size, CV_32FC2);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      origins.at<cv::Vec2f>(y, x) = {static_cast<float>(x), static_cast<float>(y)};
    }
  }
  return origins;
}

cv::Mat CarryOrigins(const cv::Mat& last_origins, const cv::Mat& last_depth_m,
                     const LatticeStep& now) {
  const cv::Size size = now.frame.depth_m.size();
  OFM_CHECK(last_origins.size() == size && last_depth_m.size() == size && now.flow.size() == size);
  const LastFrame last{last_origins, last_depth_m};
  cv::Mat origins(size, CV_32FC2), places(size, CV_32FC2);
  for (int y = 0; y < size.height; ++y) {
    const auto* flow = now.flow.ptr<cv::Vec2f>(y);
    const auto* depth = now.frame.depth_m.ptr<float>(y);
    auto* place = places.ptr<cv::Vec2f>(y);
    auto* origin = origins.ptr<cv::Vec2f>(y);
    for (int x = 0; x < size.width; ++x) {
      place[x] = flow[x] + cv::Vec2f(static_cast<float>(x), static_cast<float>(y));
      origin[x] = OriginOf(place[x], depth[x], last);
    }
  }
  for (int i = 0; i < kFilledRings; ++i) FillRing(last, now.frame.depth_m, places, origins);
  return origins;
}

}  // namespace ofm
