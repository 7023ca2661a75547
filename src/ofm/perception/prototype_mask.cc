#include "ofm/perception/prototype_mask.h"

#include <cmath>
#include <opencv2/core.hpp>

#include "ofm/base/check.h"
#include "ofm/perception/mask_sampling.h"

namespace ofm {
namespace {

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
  const MaskSampling sampling{
      MakeMaskSamples({box.x, box.width}, mask.size.width,
                      [&](double x) { return letterbox.InputX(x) * cells_x; }),
      MakeMaskSamples({box.y, box.height}, mask.size.height,
                      [&](double y) { return letterbox.InputY(y) * cells_y; })};
  const cv::Rect region = sampling.Region();
  SampleMask(ProbabilityIn(mask, region), sampling, 0.5F, image(box));
  return image;
}

}  // namespace ofm
