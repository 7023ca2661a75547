// Where each cell of a frame was in an earlier one: flow added up over frames.
#pragma once

#include <opencv2/core.hpp>

#include "ofm/perception/lattice_flow.h"

namespace ofm {

/// A column where nothing was: the cell's origin is not known.
inline constexpr float kNoOrigin = -1e6F;

/// Each cell is where it was. CV_32FC2: column and row.
cv::Mat OwnOrigins(cv::Size size);

/// The origins of the cells of `now`, from those of the frame `last` before it (CV_32FC2, kNoOrigin
/// = not known). Along its flow a cell comes from the nearest of four cells that may be the same
/// surface by their depth, and keeps its distance to it, so that nothing is blended over an
/// object's edge and motions of parts of a cell add up. A cell that flow takes to another surface,
/// as it does beside edges and where something came into view, goes with a neighbour of its own
/// depth, if there is one whose way leads to that depth. A pure function.
cv::Mat CarryOrigins(const cv::Mat& last_origins, const cv::Mat& last_depth_m,
                     const LatticeStep& now);

}  // namespace ofm
