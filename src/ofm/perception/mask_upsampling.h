// From cells to pixels.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "ofm/camera/ideal_lattice.h"

namespace ofm {

/// The pixels of `moving` cells (CV_8UC1, 255 = moving), as CV_8UC1 of the camera's image. Where
/// cells disagree with their neighbours, a pixel follows the one of the nine nearest cells whose
/// depth is most like its own, so that the mask ends where the object does. `cell_depth_m` and
/// `depth_m`: CV_32FC1, 0 = none; pixels without depth follow their own cell.
cv::Mat UpsampleMask(const IdealLattice& cells, const cv::Mat& moving, const cv::Mat& cell_depth_m,
                     const cv::Mat& depth_m);

/// The same for many objects' masks, which may overlap; each pixel is looked at once for all.
std::vector<cv::Mat> UpsampleMasks(const IdealLattice& cells, std::span<const cv::Mat> masks,
                                   const cv::Mat& cell_depth_m, const cv::Mat& depth_m);

}  // namespace ofm
