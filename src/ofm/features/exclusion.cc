#include "ofm/features/exclusion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "ofm/base/check.h"

namespace ofm {

bool IsExcluded(const cv::Mat& excluded, const Eigen::Vector2f& pixel) {
  if (excluded.empty()) return false;
  const int x = std::clamp(static_cast<int>(std::lround(pixel.x())), 0, excluded.cols - 1);
  const int y = std::clamp(static_cast<int>(std::lround(pixel.y())), 0, excluded.rows - 1);
  return excluded.ptr(y)[x] != 0;
}

void EraseExcluded(const cv::Mat& excluded, Features& features) {
  OFM_CHECK(excluded.empty() || excluded.type() == CV_8UC1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (IsExcluded(excluded, features.keypoints[i].pixel)) continue;
    features.keypoints[kept] = features.keypoints[i];
    features.descriptors[kept] = features.descriptors[i];
    if (!features.patches.empty()) features.patches[kept] = features.patches[i];
    ++kept;
  }
  features.keypoints.resize(kept);
  features.descriptors.resize(kept);
  if (!features.patches.empty()) features.patches.resize(kept);
}

}  // namespace ofm
