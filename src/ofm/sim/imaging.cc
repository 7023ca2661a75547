#include "ofm/sim/imaging.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "ofm/base/check.h"

namespace ofm {

cv::Mat BlurByMotion(const ImagingOptions& options, double time_s, double speed_px_per_s,
                     const std::function<cv::Mat(double time_s)>& render) {
  const double motion_px = speed_px_per_s * options.exposure_s;
  const int count = std::clamp(static_cast<int>(std::ceil(motion_px / options.sub_frame_px)), 1,
                               options.max_sub_frames);
  cv::Mat sum;
  for (int k = 0; k < count; ++k) {
    const cv::Mat sharp = render(time_s + options.exposure_s * ((k + 0.5) / count - 0.5));
    OFM_CHECK(sharp.type() == CV_8UC3);
    if (count == 1) return sharp;
    if (sum.empty()) sum = cv::Mat::zeros(sharp.size(), CV_16UC3);
    cv::add(sum, sharp, sum, {}, CV_16UC3);
  }
  cv::Mat blurred;
  sum.convertTo(blurred, CV_8UC3, 1.0 / count);
  return blurred;
}

void ChangeExposure(const ImagingOptions& options, double time_s, cv::Mat& color) {
  if (options.exposure_swing == 0) return;
  constexpr double kSlow_s = 7.3, kQuick_s = 2.9;
  const double wave = 0.6 * std::sin(2 * std::numbers::pi * time_s / kSlow_s) +
                      0.4 * std::sin(2 * std::numbers::pi * time_s / kQuick_s + 1);
  color.convertTo(color, CV_8UC3, std::exp2(options.exposure_swing * wave));
}

}  // namespace ofm
