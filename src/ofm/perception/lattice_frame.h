// A frame as motion is looked at on it: small, undistorted, one cell per few pixels.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "ofm/camera/ideal_lattice.h"
#include "ofm/camera/rgbd_frame.h"
#include "ofm/perception/lattice_options.h"

namespace ofm {

/// A value: its images are never written again.
struct LatticeFrame {
  std::int64_t stamp_ns = 0, depth_stamp_ns = 0;
  cv::Mat gray;     ///< CV_8UC1, two by two pixels per cell
  cv::Mat depth_m;  ///< CV_32FC1 [m] per cell, 0 = none in range
  cv::Mat texture;  ///< CV_8UC1 per cell, 255 where flow can be trusted
};

/// Makes lattice frames and knows their geometry. Immutable.
class MotionLattice {
 public:
  /// Throws Error for an odd options.cell_px.
  MotionLattice(const PinholeCamera& camera, const LatticeOptions& options);

  LatticeFrame MakeFrame(const RgbdFrame& frame) const;
  const IdealLattice& cells() const { return cells_; }
  /// Pixel coordinates of this camera are cells.
  const PinholeCamera& camera() const { return cells_.camera(); }
  cv::Size size() const { return cells_.size(); }

 private:
  LatticeOptions options_;
  IdealLattice cells_, gray_;
};

}  // namespace ofm
