#include "ofm/perception/mask_upsampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace ofm {
namespace {

/// What the cell of most similar depth among the nine around `cell` says.
std::uint8_t FollowDepth(const cv::Mat& moving, const cv::Mat& cell_depth_m, cv::Point cell,
                         float depth_m) {
  std::uint8_t answer = moving.at<std::uint8_t>(cell);
  float least = std::numeric_limits<float>::max();
  const int bottom = std::min(cell.y + 1, moving.rows - 1);
  const int right = std::min(cell.x + 1, moving.cols - 1);
  for (int y = std::max(cell.y - 1, 0); y <= bottom; ++y) {
    for (int x = std::max(cell.x - 1, 0); x <= right; ++x) {
      const float other = cell_depth_m.at<float>(y, x);
      const float difference = std::abs(other - depth_m);
      if (other <= 0 || difference >= least) continue;
      least = difference;
      answer = moving.at<std::uint8_t>(y, x);
    }
  }
  return answer;
}

/// 255 at the cells within `around` that are not as all of their neighbours.
cv::Mat FindDisagreement(const cv::Mat& moving, const cv::Rect& around) {
  cv::Mat disagree = cv::Mat::zeros(moving.size(), CV_8UC1);
  if (around.empty()) return disagree;
  cv::Mat any, all;
  const cv::Mat window = cv::Mat::ones(3, 3, CV_8UC1);
  cv::dilate(moving(around), any, window);
  cv::erode(moving(around), all, window);
  cv::compare(any, all, disagree(around), cv::CMP_NE);
  return disagree;
}

}  // namespace

cv::Mat UpsampleMask(const IdealLattice& cells, const cv::Mat& moving, const cv::Mat& cell_depth_m,
                     const cv::Mat& depth_m) {
  const cv::Rect lattice({}, moving.size());
  cv::Rect around = cv::boundingRect(moving);
  around = (around - cv::Point(1, 1) + cv::Size(2, 2)) & lattice;
  const cv::Mat disagree = FindDisagreement(moving, around);
  const cv::Mat& nearest = cells.nearest_points();
  cv::Mat mask = cv::Mat::zeros(nearest.size(), CV_8UC1);
  const cv::Rect area = cells.ImageRect(around);
  for (int y = area.y; y < area.br().y; ++y) {
    const auto* points = nearest.ptr<cv::Vec2s>(y);
    const float* depth = depth_m.ptr<float>(y);
    std::uint8_t* out = mask.ptr<std::uint8_t>(y);
    for (int x = area.x; x < area.br().x; ++x) {
      const cv::Point cell(points[x][0], points[x][1]);
      const bool follow = disagree.at<std::uint8_t>(cell) != 0 && depth[x] > 0;
      out[x] = follow ? FollowDepth(moving, cell_depth_m, cell, depth[x])
                      : moving.at<std::uint8_t>(cell);
    }
  }
  return mask;
}

}  // namespace ofm
