#include "ofm/perception/lattice_frame.h"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

#include "ofm/base/error.h"

namespace ofm {
namespace {

/// Mean absolute gradient around each cell, over the threshold or not.
cv::Mat FindTexture(const cv::Mat& gray, cv::Size cells, int min_texture) {
  constexpr int kWindow = 7;
  cv::Mat dx, dy, sum, mean;
  cv::Sobel(gray, dx, CV_16S, 1, 0);
  cv::Sobel(gray, dy, CV_16S, 0, 1);
  sum = cv::abs(dx) + cv::abs(dy);
  cv::boxFilter(sum, mean, -1, {kWindow, kWindow});
  cv::resize(mean, mean, cells, 0, 0, cv::INTER_AREA);
  return mean > min_texture;
}

}  // namespace

MotionLattice::MotionLattice(const PinholeCamera& camera, const LatticeOptions& options)
    : options_(options), cells_(camera, options.cell_px), gray_(camera, options.cell_px / 2, 2) {
  if (options.cell_px % 2 != 0) {
    throw Error(
        fmt::format("dynamics.motion.lattice.cell_px: must be even, not {}", options.cell_px));
  }
}

LatticeFrame MotionLattice::MakeFrame(const RgbdFrame& frame) const {
  LatticeFrame result;
  result.stamp_ns = frame.stamp_ns;
  result.depth_stamp_ns = frame.depth_stamp_ns;
  result.gray = gray_.SampleMean(frame.gray);
  result.depth_m = cells_.SampleNearest(frame.depth_m);
  const cv::Mat in_range =
      (result.depth_m >= options_.min_depth_m) & (result.depth_m <= options_.max_depth_m);
  result.depth_m.setTo(0, ~in_range);  // NaN is in no range
  result.texture = FindTexture(result.gray, size(), options_.min_texture);
  return result;
}

}  // namespace ofm
