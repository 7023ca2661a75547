#include "ofm/perception/mask_growth.h"

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "ofm/base/check.h"

namespace ofm {
namespace {

/// The pixels beside the mask's edge, of all directions.
bool IsAtEdge(const cv::Mat& mask, int x, int y) {
  return (x > 0 && mask.ptr(y)[x - 1] == 0) || (x + 1 < mask.cols && mask.ptr(y)[x + 1] == 0) ||
         (y > 0 && mask.ptr(y - 1)[x] == 0) || (y + 1 < mask.rows && mask.ptr(y + 1)[x] == 0);
}

std::vector<cv::Point> FindEdge(const cv::Mat& depth_m, const cv::Mat& mask) {
  std::vector<cv::Point> edge;
  for (int y = 0; y < mask.rows; ++y) {
    const std::uint8_t* set = mask.ptr(y);
    const auto* depth = depth_m.ptr<float>(y);
    for (int x = 0; x < mask.cols; ++x) {
      if (set[x] != 0 && depth[x] > 0 && IsAtEdge(mask, x, y)) edge.emplace_back(x, y);
    }
  }
  return edge;
}

/// Adds a ring of neighbours of `edge` to the mask and gives them; where `within` is not empty,
/// only those that are set in it.
std::vector<cv::Point> AddRing(const std::vector<cv::Point>& edge, const MaskGrowth& growth,
                               const cv::Mat& depth_m, const cv::Mat& within, cv::Mat& mask) {
  std::vector<cv::Point> ring;
  for (const cv::Point& pixel : edge) {
    const float here_m = depth_m.at<float>(pixel);
    const cv::Point neighbours[4] = {{pixel.x - 1, pixel.y},
                                     {pixel.x + 1, pixel.y},
                                     {pixel.x, pixel.y - 1},
                                     {pixel.x, pixel.y + 1}};
    for (const cv::Point& other : neighbours) {
      if (other.x < 0 || other.y < 0 || other.x >= mask.cols || other.y >= mask.rows) continue;
      std::uint8_t& set = mask.at<std::uint8_t>(other);
      const float there_m = depth_m.at<float>(other);
      if (set != 0 || there_m <= 0 || !growth.range.Contains(there_m)) continue;
      if (std::abs(there_m - here_m) > growth.step_m) continue;
      if (!within.empty() && within.at<std::uint8_t>(other) == 0) continue;
      set = 255;
      ring.push_back(other);
    }
  }
  return ring;
}

}  // namespace

void GrowAlongDepth(const cv::Mat& depth_m, const MaskGrowth& growth, cv::Mat& mask) {
  OFM_CHECK(mask.type() == CV_8UC1 && depth_m.type() == CV_32FC1 && mask.size() == depth_m.size());
  OFM_CHECK(growth.free.empty() || growth.free.size() == mask.size());
  std::vector<cv::Point> edge = FindEdge(depth_m, mask);
  int added = 0;
  for (int distance = 0; !edge.empty(); ++distance) {
    const bool everywhere = distance < growth.distance_px && added < growth.max_added;
    if (!everywhere && growth.free.empty()) break;
    edge = AddRing(edge, growth, depth_m, everywhere ? cv::Mat() : growth.free, mask);
    added += static_cast<int>(edge.size());
  }
}

}  // namespace ofm
