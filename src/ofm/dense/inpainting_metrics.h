// How much of what people hid was filled in, and how well.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace ofm {

struct InpaintingMetrics {
  std::size_t hidden_pixels = 0;  ///< that truly show an actor
  std::size_t filled_pixels = 0;  ///< of these, with a depth in the inpainted frame
  double filled_share = 0;        ///< 0 where nothing was hidden
  /// Of the filled ones that have a depth in the true static frame; NaN where there are none.
  double median_depth_error_m = 0;
  double psnr_db = 0;  ///< of the filled ones' colours against the true static frame's
};

/// Compares inpainted frames with the same frames without actors.
class InpaintingMeter {
 public:
  /// CV_8UC3 and CV_32FC1 [m]; `actors`: CV_8UC1, not 0 where the frame truly showed an actor.
  void AddFrame(const cv::Mat& color, const cv::Mat& depth_m, const cv::Mat& actors,
                const cv::Mat& true_color, const cv::Mat& true_depth_m);

  InpaintingMetrics metrics() const;

 private:
  std::size_t hidden_ = 0, filled_ = 0;
  std::vector<float> depth_errors_m_;
  double squared_color_error_ = 0;  // sum over pixels and channels
};

}  // namespace ofm
