#include "ofm/dense/inpainting_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ofm/base/check.h"
#include "ofm/base/median.h"

namespace ofm {

void InpaintingMeter::AddFrame(const cv::Mat& color, const cv::Mat& depth_m, const cv::Mat& actors,
                               const cv::Mat& true_color, const cv::Mat& true_depth_m) {
  for (const cv::Mat* image : {&color, &depth_m, &true_color, &true_depth_m}) {
    OFM_CHECK(image->size() == actors.size());
  }
  for (int row = 0; row < actors.rows; ++row) {
    for (int column = 0; column < actors.cols; ++column) {
      if (actors.at<std::uint8_t>(row, column) == 0) continue;
      ++hidden_;
      const float depth = depth_m.at<float>(row, column);
      if (depth == 0) continue;
      ++filled_;
      const float truth = true_depth_m.at<float>(row, column);
      if (truth > 0) depth_errors_m_.push_back(std::abs(depth - truth));
      const auto& seen = color.at<cv::Vec3b>(row, column);
      const auto& expected = true_color.at<cv::Vec3b>(row, column);
      for (int i = 0; i < 3; ++i) squared_color_error_ += std::pow(seen[i] - expected[i], 2);
    }
  }
}

InpaintingMetrics InpaintingMeter::metrics() const {
  InpaintingMetrics metrics{hidden_, filled_, 0, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::quiet_NaN()};
  if (hidden_ > 0)
    metrics.filled_share = static_cast<double>(filled_) / static_cast<double>(hidden_);
  if (!depth_errors_m_.empty()) {
    metrics.median_depth_error_m = UpperMedian(depth_errors_m_);
  }
  if (filled_ > 0) {
    const double mean_square = squared_color_error_ / (3. * static_cast<double>(filled_));
    metrics.psnr_db = 10 * std::log10(255. * 255. / mean_square);  // infinite where equal
  }
  return metrics;
}

}  // namespace ofm
