// Frames on the lattice and the flow between them: carries masks and tells what moves.
#pragma once

#include <optional>

#include "ofm/perception/dense_flow.h"
#include "ofm/perception/lattice_frame.h"

namespace ofm {

/// A frame and how its cells got there. A value: copies share the images.
struct LatticeStep {
  LatticeFrame frame;
  cv::Mat flow;  ///< CV_32FC2 per cell: where it was in the frame before, relative [cells]; empty
                 ///< where there is none before, or one that is not older
};

/// Dense flow from each frame to the one before. One object serves one thread.
class LatticeFlow {
 public:
  /// Throws Error for an odd options.cell_px.
  LatticeFlow(const PinholeCamera& camera, const LatticeOptions& options)
      : lattice_(camera, options) {}

  const MotionLattice& lattice() const { return lattice_; }

  LatticeStep Process(const RgbdFrame& frame);

  /// Per cell of `current` where it was in `last`, relative [cells]. No flow (tiny images) is flow
  /// zero. Depends on the two frames alone.
  cv::Mat FlowToLast(const LatticeFrame& current, const LatticeFrame& last);

 private:
  MotionLattice lattice_;
  DenseFlow dense_flow_;
  std::optional<LatticeFrame> last_;
};

}  // namespace ofm
