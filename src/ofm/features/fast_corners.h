// FAST corners of an image, without those next to a stronger one.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ofm/features/even_distribution.h"
#include "ofm/features/image_pyramid.h"
#include "ofm/features/orb_kernels.h"

namespace ofm {

/// Corners of one image and the scores of all its pixels. Keeps its buffers between calls.
class FastDetector {
 public:
  explicit FastDetector(const OrbKernels& kernels) : kernels_(kernels) {}

  /// FAST-9-16 corners with a score over `threshold` (0 to 254) that are the maximum of their 3 x 3
  /// pixels and at least `margin` >= 4 pixels from the border, row by row. The list is valid until
  /// the next call.
  std::vector<Corner>& Detect(const PaddedImage& image, int threshold, int margin);
  std::vector<Corner>& corners() { return corners_; }

  /// Sub-pixel offset of the score's maximum from the corner, within half a pixel: the vertex of
  /// the parabola through three scores in each axis.
  Eigen::Vector2f RefinedOffset(const Corner& corner) const;

 private:
  const OrbKernels& kernels_;
  PaddedImage scores_;
  std::vector<Corner> corners_;
  std::vector<std::uint16_t> columns_;
};

}  // namespace ofm
