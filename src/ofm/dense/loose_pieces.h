// Pieces of people and of what they carry that no mask covers.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/dense/dense_options.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// A connected part of a depth image off the masks.
struct SurfacePiece {
  std::vector<cv::Point> pixels;
  /// Of its outline, what is no edge of its own: the image's border, or a mask at the same depth.
  double cut_share = 0;
};

/// One of several images from nearby, all of one size: every `step`-th pixel of the camera.
struct PieceView {
  cv::Mat depth_m;  ///< CV_32FC1 [m], 0 = not measured
  cv::Mat dynamic;  ///< CV_8UC1, not 0 = moves
  RigidTransform reference_from_view;
};

/// Parts of `view` whose neighbours are no depth edges (KeyframeCloudOptions::edge_sigmas), none
/// larger than max_piece_share of the image; in the order of their first pixels. Where nothing is
/// measured the outline is what lies across.
std::vector<SurfacePiece> FindSurfacePieces(const PieceView& view,
                                            const KeyframeCloudOptions& options);

/// For each view CV_8UC1 of its size, 255 where a small piece probably belongs to what moves: the
/// other views look through it or have a mask there, it is cut off by a mask or the image's border,
/// where networks miss people, and it is so small that the room hardly lacks it. With one view
/// there is nothing to go by, and nothing is found. `rays`: (x, y) at z = 1 m of all the camera's
/// pixels, distortion undone, row by row.
std::vector<cv::Mat> FindLoosePieces(std::span<const PieceView> views, const PinholeCamera& camera,
                                     std::span<const Eigen::Vector2f> rays,
                                     const KeyframeCloudOptions& options);

}  // namespace ofm
