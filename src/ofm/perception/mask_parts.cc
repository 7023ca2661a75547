#include "ofm/perception/mask_parts.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "ofm/base/check.h"

namespace ofm {
namespace {

/// Writes `value` into the pixels whose label is chosen.
void SetWhere(const cv::Mat& labels, const std::vector<char>& chosen, std::uint8_t value,
              cv::Mat& mask) {
  for (int y = 0; y < mask.rows; ++y) {
    const int* label = labels.ptr<int>(y);
    std::uint8_t* set = mask.ptr(y);
    for (int x = 0; x < mask.cols; ++x) {
      if (chosen[label[x]] != 0) set[x] = value;
    }
  }
}

}  // namespace

int KeepLargestParts(double min_share, cv::Mat& mask) {
  OFM_CHECK(mask.type() == CV_8UC1);
  cv::Mat labels, statistics, centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centroids, 8);
  int largest = 0, left = 0, dropped = 0;
  for (int i = 1; i < count; ++i) {
    largest = std::max(largest, statistics.at<int>(i, cv::CC_STAT_AREA));
  }
  std::vector<char> small(static_cast<std::size_t>(count), 0);
  for (int i = 1; i < count; ++i) {
    const int area = statistics.at<int>(i, cv::CC_STAT_AREA);
    small[i] = area < min_share * largest ? 1 : 0;
    small[i] != 0 ? ++dropped : left += area;
  }
  if (dropped > 0) SetWhere(labels, small, 0, mask);
  return left;
}

void CloseHoles(int max_area, cv::Mat& mask) {
  OFM_CHECK(mask.type() == CV_8UC1);
  if (mask.empty() || max_area <= 0) return;
  cv::Mat labels, statistics, centroids;
  const int count = cv::connectedComponentsWithStats(mask == 0, labels, statistics, centroids, 4);
  std::vector<char> hole(static_cast<std::size_t>(count), 0);
  bool any = false;
  for (int i = 1; i < count; ++i) {
    const int* row = statistics.ptr<int>(i);
    const int left = row[cv::CC_STAT_LEFT], top = row[cv::CC_STAT_TOP];
    const bool is_open = left == 0 || top == 0 || left + row[cv::CC_STAT_WIDTH] == mask.cols ||
                         top + row[cv::CC_STAT_HEIGHT] == mask.rows;
    if (is_open || row[cv::CC_STAT_AREA] > max_area) continue;
    hole[i] = 1;
    any = true;
  }
  if (any) SetWhere(labels, hole, 255, mask);
}

}  // namespace ofm
