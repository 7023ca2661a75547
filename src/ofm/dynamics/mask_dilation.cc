#include "ofm/dynamics/mask_dilation.h"

#include <algorithm>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "ofm/base/check.h"

namespace ofm {
namespace {

/// Half the width of the ellipse's row at a distance of 0, 1, ... radius from its centre.
std::vector<int> HalfWidths(int radius) {
  const cv::Size size(2 * radius + 1, 2 * radius + 1);
  const cv::Mat ellipse = cv::getStructuringElement(cv::MORPH_ELLIPSE, size);
  std::vector<int> half_widths;
  for (int dy = 0; dy <= radius; ++dy) {
    half_widths.push_back((cv::countNonZero(ellipse.row(radius + dy)) - 1) / 2);
  }
  return half_widths;
}

/// Writes the ellipses around the run [begin, end) of row `y`.
void AddRun(int y, int begin, int end, const std::vector<int>& half_widths, cv::Mat& mask) {
  const int radius = static_cast<int>(half_widths.size()) - 1;
  const int top = std::max(0, y - radius), bottom = std::min(mask.rows - 1, y + radius);
  for (int row = top; row <= bottom; ++row) {
    const int reach = half_widths[std::abs(row - y)];
    const int left = std::max(0, begin - reach), right = std::min(mask.cols, end + reach);
    std::memset(mask.ptr(row) + left, 255, static_cast<std::size_t>(right - left));
  }
}

}  // namespace

void AddDilated(const cv::Mat& object, int radius_px, cv::Mat& mask) {
  OFM_CHECK(object.type() == CV_8UC1 && mask.type() == CV_8UC1 && object.size() == mask.size());
  OFM_CHECK(radius_px >= 0 && object.data != mask.data);
  const std::vector<int> half_widths = HalfWidths(radius_px);
  for (int y = 0; y < object.rows; ++y) {
    const std::uint8_t* row = object.ptr(y);
    const std::uint8_t* row_end = row + object.cols;
    const auto is_object = [](std::uint8_t value) { return value != 0; };
    for (const std::uint8_t* begin = row;;) {
      begin = std::find_if(begin, row_end, is_object);
      if (begin == row_end) break;
      const std::uint8_t* end = std::find(begin, row_end, std::uint8_t{0});
      AddRun(y, static_cast<int>(begin - row), static_cast<int>(end - row), half_widths, mask);
      begin = end;
    }
  }
}

}  // namespace ofm
