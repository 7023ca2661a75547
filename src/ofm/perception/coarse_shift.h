// Where an object went between two frames, roughly.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "ofm/perception/flow_frame.h"
#include "ofm/perception/segmentation.h"

namespace ofm {

/// Where the search begins and ends.
struct CoarseSearch {
  Eigen::Vector2f expected_px = {0, 0};  ///< shift that is expected
  int reach_px = 96;                     ///< looked at around it, in x and y
};

struct CoarseShift {
  Eigen::Vector2f shift_px = {0, 0};
  double agreement = 0;  ///< share of the object's pixels whose depth is found there, 0 to 1
};

/// The shift under which `instance` is most likely found in `to`, to a pixel of the pyramids'
/// coarsest level: its pixels have the grey levels and depths that they had, and the surroundings
/// do not have the object's depth. Depth counts only where it was measured. Plain objects, which
/// flow cannot follow, are found by their outline in depth.
CoarseShift FindCoarseShift(const Instance& instance, const FlowFrame& from, const FlowFrame& to,
                            const CoarseSearch& search);

}  // namespace ofm
