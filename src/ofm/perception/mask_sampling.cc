#include "ofm/perception/mask_sampling.h"

#include <cstdint>
#include <opencv2/core.hpp>

#include "ofm/base/check.h"

namespace ofm {

void SampleMask(const cv::Mat& probability, const MaskSampling& sampling, float threshold,
                cv::Mat pixels) {
  const cv::Rect region = sampling.Region();
  OFM_CHECK(probability.type() == CV_32FC1 && probability.size() == region.size());
  OFM_CHECK(pixels.type() == CV_8UC1 && pixels.rows == std::ssize(sampling.rows) &&
            pixels.cols == std::ssize(sampling.columns));
  std::vector<float> blended(region.width);
  for (int y = 0; y < pixels.rows; ++y) {
    const MaskSample& row = sampling.rows[y];
    const float* upper = probability.ptr<float>(row.first - region.y);
    const float* lower = probability.ptr<float>(row.second - region.y);
    for (int x = 0; x < region.width; ++x) {
      blended[x] = upper[x] + row.weight * (lower[x] - upper[x]);
    }
    std::uint8_t* to = pixels.ptr(y);
    for (int x = 0; x < pixels.cols; ++x) {
      const MaskSample& column = sampling.columns[x];
      const float left = blended[column.first - region.x];
      const float right = blended[column.second - region.x];
      to[x] = left + column.weight * (right - left) > threshold ? 255 : 0;
    }
  }
}

cv::Mat PasteMask(const ProbabilityMask& mask, float threshold, const cv::Rect& box,
                  cv::Size image) {
  OFM_CHECK(mask.values.type() == CV_32FC1 && !mask.values.empty());
  OFM_CHECK(mask.extent.width > 0 && mask.extent.height > 0);
  cv::Mat pasted = cv::Mat::zeros(image, CV_8UC1);
  if (box.empty()) return pasted;
  const double cells_x = mask.values.cols / mask.extent.width;
  const double cells_y = mask.values.rows / mask.extent.height;
  const MaskSampling sampling{
      MakeMaskSamples({box.x, box.width}, mask.values.cols,
                      [&](double x) { return (x - mask.extent.x) * cells_x; }),
      MakeMaskSamples({box.y, box.height}, mask.values.rows,
                      [&](double y) { return (y - mask.extent.y) * cells_y; })};
  SampleMask(mask.values(sampling.Region()), sampling, threshold, pasted(box));
  return pasted;
}

}  // namespace ofm
