#include "ofm/dense/usable_pixels.h"

#include <opencv2/imgproc.hpp>

#include "ofm/camera/depth_noise.h"

namespace ofm {
namespace {

constexpr float kFar_m = 1e6f;

/// 255 where depth is measured; false for NaN and infinity.
cv::Mat MeasuredPixels(const cv::Mat& depth_m) { return (depth_m > 0) & (depth_m < kFar_m); }

cv::Mat Square(int radius_px) {
  return cv::getStructuringElement(cv::MORPH_RECT, {2 * radius_px + 1, 2 * radius_px + 1});
}

/// Least and greatest depth of the `seed` pixels within `radius_px`: kFar_m and 0 where none is.
struct DepthBounds {
  cv::Mat least_m, greatest_m;
};

DepthBounds LocalDepthBounds(const cv::Mat& depth_m, const cv::Mat& seed, int radius_px) {
  DepthBounds bounds{cv::Mat(depth_m.size(), CV_32F, cv::Scalar(kFar_m)),
                     cv::Mat(depth_m.size(), CV_32F, cv::Scalar(0))};
  depth_m.copyTo(bounds.least_m, seed);
  depth_m.copyTo(bounds.greatest_m, seed);
  cv::erode(bounds.least_m, bounds.least_m, Square(radius_px));
  cv::dilate(bounds.greatest_m, bounds.greatest_m, Square(radius_px));
  return bounds;
}

}  // namespace

cv::Mat FindSmoothPixels(const cv::Mat& depth_m, const KeyframeCloudOptions& options) {
  cv::Mat smooth = MeasuredPixels(depth_m);
  const DepthBounds bounds = LocalDepthBounds(depth_m, smooth, 1);
  cv::Mat measured_count;
  cv::boxFilter(smooth / 255, measured_count, CV_8U, {3, 3}, {-1, -1}, false, cv::BORDER_REPLICATE);
  for (int row = 0; row < depth_m.rows; ++row) {
    const auto* depth = depth_m.ptr<float>(row);
    const auto* least = bounds.least_m.ptr<float>(row);
    const auto* greatest = bounds.greatest_m.ptr<float>(row);
    const auto* count = measured_count.ptr<std::uint8_t>(row);
    auto* out = smooth.ptr<std::uint8_t>(row);
    for (int column = 0; column < depth_m.cols; ++column) {
      if (out[column] == 0) continue;
      const double z = depth[column];
      const bool edge = greatest[column] - z > options.edge_sigmas * DepthSigma(z) ||
                        z - least[column] > options.edge_sigmas * DepthSigma(least[column]);
      if (edge || count[column] < options.min_measured_pixels) out[column] = 0;
    }
  }
  return smooth;
}

cv::Mat FindDynamicPixels(const cv::Mat& mask, const cv::Mat& depth_m,
                          const KeyframeCloudOptions& options) {
  if (mask.empty()) return cv::Mat::zeros(depth_m.size(), CV_8UC1);
  cv::Mat dynamic;
  const int radius = options.mask_dilation_px;
  cv::dilate(mask, dynamic,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1}));
  if (options.mask_margin_px == 0) return dynamic;
  // A mask is often too large by a few pixels: its rim tells nothing about the object's depth.
  constexpr int kRim_px = 2;
  cv::Mat seed;
  cv::erode(mask, seed, Square(kRim_px));
  seed &= MeasuredPixels(depth_m);
  const DepthBounds bounds = LocalDepthBounds(depth_m, seed, options.mask_margin_px + kRim_px);
  const double alike = options.mask_margin_depth_m;
  cv::Mat margin = (depth_m >= bounds.least_m - alike) & (depth_m <= bounds.greatest_m + alike);
  return dynamic | margin;
}

cv::Mat FindUsablePixels(const LabelledFrame& frame, const KeyframeCloudOptions& options) {
  cv::Mat usable = FindSmoothPixels(frame.depth_m, options);
  usable.setTo(0, FindDynamicPixels(frame.dynamic_mask, frame.depth_m, options));
  return usable;
}

}  // namespace ofm
