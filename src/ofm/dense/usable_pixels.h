// Which pixels of a key frame may enter the map.
#pragma once

#include <opencv2/core/mat.hpp>

#include "ofm/dense/dense_options.h"
#include "ofm/dense/labelled_frame.h"

namespace ofm {

/// CV_8UC1, 255 where depth is measured and lies on no depth edge: no neighbour differs by more
/// than edge_sigmas standard deviations of the depth noise (of the nearer of both), and enough of
/// the 3 x 3 is measured. Flying pixels and both rims of each depth step go.
cv::Mat FindSmoothPixels(const cv::Mat& depth_m, const KeyframeCloudOptions& options);

/// CV_8UC1, 255 where a pixel moves or may belong to what moves: the mask dilated, and in a wider
/// margin all pixels whose depth is that of the masked surface nearby. With an empty mask none
/// does.
cv::Mat FindDynamicPixels(const cv::Mat& mask, const cv::Mat& depth_m,
                          const KeyframeCloudOptions& options);

/// CV_8UC1, 255 where a pixel is smooth and static.
cv::Mat FindUsablePixels(const LabelledFrame& frame, const KeyframeCloudOptions& options);

}  // namespace ofm
