#include "ofm/perception/prototype_mask.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "ofm/base/check.h"

namespace ofm {
namespace {

/// Where an image pixel's centre lies between two neighbouring cells of a row or column.
struct Sample {
  int first, second;  // cells, clamped to the prototype
  float weight;       // of the second
};

/// Samples for `count` pixels. `position` gives the continuous place of a pixel's centre, in cells.
template <class Position>
std::vector<Sample> MakeSamples(int begin, int count, int cells, Position&& position) {
  std::vector<Sample> samples(count);
  for (int i = 0; i < count; ++i) {
    const double centre = position(begin + i + 0.5) - 0.5;
    const double floor = std::floor(centre);
    const int cell = static_cast<int>(floor);
    samples[i] = {std::clamp(cell, 0, cells - 1), std::clamp(cell + 1, 0, cells - 1),
                  static_cast<float>(centre - floor)};
  }
  return samples;
}

/// sigmoid(coefficients · prototypes) in the cells of `region`.
cv::Mat ProbabilityIn(const PrototypeMask& mask, const cv::Rect& region) {
  cv::Mat sum = cv::Mat::zeros(region.size(), CV_32FC1);
  for (int m = 0; m < mask.prototypes.rows; ++m) {
    const float coefficient = mask.coefficients.at<float>(m);
    const float* prototype = mask.prototypes.ptr<float>(m);
    for (int y = 0; y < region.height; ++y) {
      const float* from = prototype + (region.y + y) * mask.size.width + region.x;
      float* to = sum.ptr<float>(y);
      for (int x = 0; x < region.width; ++x) to[x] += coefficient * from[x];
    }
  }
  for (int y = 0; y < region.height; ++y) {
    float* row = sum.ptr<float>(y);
    for (int x = 0; x < region.width; ++x) row[x] = 1.0F / (1.0F + std::exp(-row[x]));
  }
  return sum;
}

}  // namespace

cv::Mat PastePrototypeMask(const PrototypeMask& mask, const Letterbox& letterbox,
                           const cv::Rect& box) {
  OFM_CHECK(mask.prototypes.cols == mask.size.area());
  OFM_CHECK(mask.coefficients.rows == mask.prototypes.rows && mask.coefficients.isContinuous());
  cv::Mat image = cv::Mat::zeros(letterbox.image, CV_8UC1);
  if (box.empty()) return image;

  const double cells_x = static_cast<double>(mask.size.width) / letterbox.input.width;
  const double cells_y = static_cast<double>(mask.size.height) / letterbox.input.height;
  const auto columns = MakeSamples(box.x, box.width, mask.size.width,
                                   [&](double x) { return letterbox.InputX(x) * cells_x; });
  const auto rows = MakeSamples(box.y, box.height, mask.size.height,
                                [&](double y) { return letterbox.InputY(y) * cells_y; });
  const cv::Rect region(cv::Point(columns.front().first, rows.front().first),
                        cv::Point(columns.back().second + 1, rows.back().second + 1));
  const cv::Mat probability = ProbabilityIn(mask, region);

  std::vector<float> blended(region.width);
  for (int y = 0; y < box.height; ++y) {
    const float* upper = probability.ptr<float>(rows[y].first - region.y);
    const float* lower = probability.ptr<float>(rows[y].second - region.y);
    const float weight = rows[y].weight;
    for (int x = 0; x < region.width; ++x) blended[x] = upper[x] + weight * (lower[x] - upper[x]);
    std::uint8_t* to = image.ptr(box.y + y) + box.x;
    for (int x = 0; x < box.width; ++x) {
      const float left = blended[columns[x].first - region.x];
      const float right = blended[columns[x].second - region.x];
      to[x] = left + columns[x].weight * (right - left) > 0.5F ? 255 : 0;
    }
  }
  return image;
}

}  // namespace ofm
