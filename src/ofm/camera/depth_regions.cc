#include "ofm/camera/depth_regions.h"

#include <cmath>
#include <cstdint>

#include "ofm/base/check.h"

namespace ofm {
namespace {

/// All that is joined to `seed` and not yet taken.
DepthRegion Flood(const cv::Mat& depth_m, float step_m, cv::Point seed, cv::Mat& open) {
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
      if (std::abs(depth_m.ptr<float>(other.y)[other.x] - here_m) > step_m) continue;
      is_open = 0;
      region.pixels.push_back(other);
    }
  }
  return region;
}

}  // namespace

std::vector<DepthRegion> FindDepthRegions(const cv::Mat& mask, const cv::Mat& depth_m,
                                          float step_m) {
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
      if (open.ptr(y)[x] != 0) regions.push_back(Flood(depth_m, step_m, {x, y}, open));
    }
  }
  return regions;
}

}  // namespace ofm
