#include "ofm/perception/mask_upsampling.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace ofm {
namespace {

/// Cells with a rim of one cell around them, so that each has nine neighbours.
class Neighbourhoods {
 public:
  Neighbourhoods(const cv::Mat& moving, const cv::Mat& cell_depth_m) {
    constexpr int kRim = cv::BORDER_CONSTANT | cv::BORDER_ISOLATED;
    cv::copyMakeBorder(moving, moving_, 1, 1, 1, 1, kRim, 0);
    cv::copyMakeBorder(cell_depth_m, depth_m_, 1, 1, 1, 1, kRim, 0);
    depth_m_.setTo(std::numeric_limits<float>::infinity(), ~(depth_m_ > 0));  // is like none
  }

  /// What the cell of most similar depth among the nine around `cell` says; `cell` itself where
  /// none has a depth.
  std::uint8_t FollowDepth(cv::Point cell, float depth_m) const {
    std::uint8_t answer = moving_.at<std::uint8_t>(cell.y + 1, cell.x + 1);
    float least = std::numeric_limits<float>::max();
    for (int y = cell.y; y < cell.y + 3; ++y) {
      const float* depths = depth_m_.ptr<float>(y) + cell.x;
      const std::uint8_t* says = moving_.ptr<std::uint8_t>(y) + cell.x;
      for (int x = 0; x < 3; ++x) {
        const float difference = std::abs(depths[x] - depth_m);
        // A select without a branch: no one could predict it, and this is a hot loop.
        const auto closer = static_cast<std::uint8_t>(difference < least ? 255 : 0);
        least = std::min(difference, least);
        answer ^= (answer ^ says[x]) & closer;
      }
    }
    return answer;
  }

 private:
  cv::Mat moving_, depth_m_;
};

/// Marks of cells that do not agree with all of their neighbours; the others stay 0 or 255.
constexpr std::uint8_t kDoubtfulStatic = 1, kDoubtfulMoving = 254;

bool IsDoubtful(std::uint8_t cell) { return cell == kDoubtfulStatic || cell == kDoubtfulMoving; }

/// Most pixels need no second look, and are passed over eight at a time.
bool AgreeEight(const std::uint8_t* pixels) {
  std::uint64_t eight = 0;
  std::memcpy(&eight, pixels, sizeof eight);
  return eight == 0 || eight == std::numeric_limits<std::uint64_t>::max();
}

/// `moving` with its marks; there are none outside of `around`.
cv::Mat MarkDoubtful(const cv::Mat& moving, const cv::Rect& around) {
  cv::Mat marked = moving.clone();
  cv::Mat any, all;
  const cv::Mat window = cv::Mat::ones(3, 3, CV_8UC1);
  cv::dilate(moving(around), any, window);
  cv::erode(moving(around), all, window);
  const cv::Mat disagree = any != all;
  marked(around).setTo(kDoubtfulStatic, disagree & ~moving(around));
  marked(around).setTo(kDoubtfulMoving, disagree & moving(around));
  return marked;
}

}  // namespace

cv::Mat UpsampleMask(const IdealLattice& cells, const cv::Mat& moving, const cv::Mat& cell_depth_m,
                     const cv::Mat& depth_m) {
  const cv::Mat& nearest = cells.nearest_points();
  cv::Mat mask = cv::Mat::zeros(nearest.size(), CV_8UC1);
  const cv::Rect lattice({}, moving.size());
  cv::Rect around = cv::boundingRect(moving);
  around = (around - cv::Point(1, 1) + cv::Size(2, 2)) & lattice;
  const cv::Rect area = cells.ImageRect(around);
  if (area.empty()) return mask;
  cv::Mat part = mask(area);
  cv::remap(MarkDoubtful(moving, around), part, nearest(area), cv::noArray(), cv::INTER_NEAREST);
  const Neighbourhoods neighbourhoods(moving, cell_depth_m);
  for (int y = area.y; y < area.br().y; ++y) {
    const auto* points = nearest.ptr<cv::Vec2s>(y);
    const float* depth = depth_m.ptr<float>(y);
    std::uint8_t* out = mask.ptr<std::uint8_t>(y);
    for (int x = area.x; x < area.br().x; ++x) {
      if (x + 8 <= area.br().x && AgreeEight(out + x)) {
        x += 7;
        continue;
      }
      if (!IsDoubtful(out[x])) continue;
      const cv::Point cell(points[x][0], points[x][1]);
      out[x] =
          depth[x] > 0 ? neighbourhoods.FollowDepth(cell, depth[x]) : moving.at<std::uint8_t>(cell);
    }
  }
  return mask;
}

}  // namespace ofm
