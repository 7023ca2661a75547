// Surfaces in a depth image.
#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "ofm/base/check.h"

namespace ofm {

/// Pixels that are joined by small depth steps.
struct DepthRegion {
  std::vector<cv::Point> pixels;
};

namespace depth_regions_detail {

/// All that is joined to `seed` and not yet taken.
template <class IsJoined>
DepthRegion Flood(const cv::Mat& depth_m, const IsJoined& is_joined, cv::Point seed,
                  cv::Mat& open) {
  DepthRegion region;
  region.pixels.push_back(seed);
  open.at<std::uint8_t>(seed) = 0;
  for (std::size_t next = 0; next < region.pixels.size(); ++next) {
    const cv::Point pixel = region.pixels[next];
    const float here_m = depth_m.ptr<float>(pixel.y)[pixel.x];
    const cv::Point neighbours[4] = {{pixel.x - 1, pixel.y},
                                     {pixel.x + 1, pixel.y},
                                     {pixel.x, pixel.y - 1},
                                     {pixel.x, pixel.y + 1}};
    for (const cv::Point& other : neighbours) {
      if (other.x < 0 || other.y < 0 || other.x >= open.cols || other.y >= open.rows) continue;
      std::uint8_t& is_open = open.ptr(other.y)[other.x];
      if (is_open == 0) continue;
      if (!is_joined(here_m, depth_m.ptr<float>(other.y)[other.x])) continue;
      is_open = 0;
      region.pixels.push_back(other);
    }
  }
  return region;
}

}  // namespace depth_regions_detail

/// Parts of `mask` (CV_8UC1, not 0 = looked at) whose 4-neighbours are joined: `is_joined` tells it
/// of two depths [m], whichever comes first. Pixels without depth belong to no part. In the order
/// of their first pixels.
template <class IsJoined>
std::vector<DepthRegion> FindDepthRegionsIf(const cv::Mat& mask, const cv::Mat& depth_m,
                                            const IsJoined& is_joined) {
  OFM_CHECK(mask.type() == CV_8UC1 && depth_m.type() == CV_32FC1 && mask.size() == depth_m.size());
  cv::Mat open(mask.size(), CV_8UC1);
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      const bool measured = mask.ptr(y)[x] != 0 && depth_m.ptr<float>(y)[x] > 0;
      open.ptr(y)[x] = measured ? 255 : 0;
    }
  }
  std::vector<DepthRegion> regions;
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (open.ptr(y)[x] == 0) continue;
      regions.push_back(depth_regions_detail::Flood(depth_m, is_joined, {x, y}, open));
    }
  }
  return regions;
}

/// The same where depths that differ by at most `step_m` are joined.
inline std::vector<DepthRegion> FindDepthRegions(const cv::Mat& mask, const cv::Mat& depth_m,
                                                 float step_m) {
  return FindDepthRegionsIf(mask, depth_m, [step_m](float here_m, float there_m) {
    return std::abs(there_m - here_m) <= step_m;
  });
}

}  // namespace ofm
