// An image in several sizes, with a smoothed copy of each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "ofm/features/orb_kernels.h"

namespace ofm {

/// 8-bit grey image whose rows can be read and written kRowPadding bytes beyond both ends.
class PaddedImage {
 public:
  /// Sets the size; the pixels' values are then unknown.
  void Resize(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  std::ptrdiff_t stride() const { return stride_; }
  std::uint8_t* Row(int y) { return pixels_.data() + kRowPadding + y * stride_; }
  const std::uint8_t* Row(int y) const { return pixels_.data() + kRowPadding + y * stride_; }

 private:
  int width_ = 0, height_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<std::uint8_t> pixels_;
};

/// Levels of sizes width / scale_factor^level. Pixel x of level l lies at
/// (x + 1/2) * scale_factor^l - 1/2 of the full image. Level 0 is smoothed by a 3 x 3 binomial
/// against the sensor's noise, which makes corners found in it easier to find again. Keeps its
/// buffers between calls.
class ImagePyramid {
 public:
  /// `scale_factor` in (1, 2]. Levels of under 1 pixel are not made.
  ImagePyramid(int levels, double scale_factor, const OrbKernels& kernels);

  /// Makes all levels of `gray` (CV_8UC1).
  void Build(const cv::Mat& gray);
  /// Smooths a level with a Gaussian of sigma 2 px into smooth(level); borders are replicated.
  void Smooth(int level);

  int levels() const { return static_cast<int>(images_.size()); }
  const PaddedImage& image(int level) const { return images_[level]; }
  const PaddedImage& smooth(int level) const { return smooth_[level]; }

 private:
  struct Column {
    int source;     ///< left or upper pixel
    double weight;  ///< of the right or lower one
  };
  Column SourceOf(int target, int size) const;
  void SmoothLevelZero(const cv::Mat& gray);
  void PlanRows(int source_width, int target_width);
  void Downscale(const PaddedImage& source, PaddedImage& target);

  int max_levels_;
  double scale_factor_;
  const OrbKernels& kernels_;
  PaddedImage raw_;  ///< the image as it came
  std::vector<PaddedImage> images_, smooth_;
  std::vector<ResampleBlock> blocks_;
  std::vector<std::int16_t> rows_[2];
  std::vector<std::uint8_t> column_sums_;
};

}  // namespace ofm
