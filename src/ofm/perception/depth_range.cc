#include "ofm/perception/depth_range.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "ofm/base/check.h"

namespace ofm {

std::optional<DepthRange> FindDepthRange(std::vector<float> depths_m, double margin_m,
                                         std::size_t min_count) {
  std::erase_if(depths_m, [](float depth_m) { return !(depth_m > 0); });
  if (depths_m.empty() || depths_m.size() < min_count) return {};
  std::sort(depths_m.begin(), depths_m.end());
  const auto margin = static_cast<float>(margin_m);
  std::size_t begin = 0, best_begin = 0, best_size = 0;
  for (std::size_t i = 0; i < depths_m.size(); ++i) {
    if (i > begin && depths_m[i] - depths_m[i - 1] > margin) begin = i;
    if (i + 1 - begin <= best_size) continue;
    best_begin = begin;
    best_size = i + 1 - begin;
  }
  const std::size_t tenth = (best_size - 1) / 10;
  return DepthRange{depths_m[best_begin + tenth] - margin,
                    depths_m[best_begin + best_size - 1 - tenth] + margin};
}

std::vector<float> SampleDepths(const cv::Mat& mask, const cv::Mat& depth_m, int step) {
  OFM_CHECK(mask.type() == CV_8UC1 && depth_m.type() == CV_32FC1 && mask.size() == depth_m.size());
  OFM_CHECK(step > 0);
  std::vector<float> depths;
  for (int y = 0; y < mask.rows; y += step) {
    const std::uint8_t* set = mask.ptr(y);
    const auto* depth = depth_m.ptr<float>(y);
    for (int x = 0; x < mask.cols; x += step) {
      if (set[x] != 0) depths.push_back(depth[x]);
    }
  }
  return depths;
}

void TrimToDepth(const cv::Mat& depth_m, const DepthRange& range, cv::Mat& mask) {
  OFM_CHECK(mask.type() == CV_8UC1 && depth_m.type() == CV_32FC1 && mask.size() == depth_m.size());
  for (int y = 0; y < mask.rows; ++y) {
    std::uint8_t* set = mask.ptr(y);
    const auto* depth = depth_m.ptr<float>(y);
    for (int x = 0; x < mask.cols; ++x) {
      if (depth[x] > 0 && !range.Contains(depth[x])) set[x] = 0;
    }
  }
}

}  // namespace ofm
