// Where every pixel of one image is in another: dense inverse search.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/video/tracking.hpp>

namespace ofm {

/// Dense optical flow (Kroeger et al., "Fast Optical Flow using Dense Inverse Search", ECCV 2016).
/// Patches learn from their neighbours within a stripe, and there is a stripe for each of OpenCV's
/// threads: for the same result everywhere set cv::setNumThreads(1). One object serves one thread.
class DenseFlow {
 public:
  DenseFlow();

  /// CV_32FC2, the displacement [px] from each pixel of `from` to its place in `to`; both CV_8UC1
  /// of one size. Where there is no texture the flow is that of the surroundings. Images too small
  /// for one patch (under 32 px a side) give no flow: an empty image.
  cv::Mat Compute(const cv::Mat& from, const cv::Mat& to);

 private:
  cv::Ptr<cv::DISOpticalFlow> search_;
};

}  // namespace ofm
