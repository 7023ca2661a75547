// Points on an object that flow can follow.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "ofm/base/options.h"
#include "ofm/perception/optical_flow.h"

namespace ofm {

struct MaskPointOptions {
  int cell_px = 15;          ///< side of a cell, which gives one point
  int max_points = 150;      ///< about; the cells of large objects grow
  double min_texture = 0.5;  ///< gradient in the direction that has least of it [grey levels / px]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("cell_px", self.cell_px, "side of a cell, which gives one point [px]", Range{4, 100});
    visit("max_points", self.max_points, "about, on one object", Range{4, 10000});
    visit("min_texture", self.min_texture, "gradient in the weakest direction [levels/px]",
          Range{0, 255});
  }
};

/// One point [px] in each cell of `box` whose pixels of `mask` (CV_8UC1 of the pyramid's size, not
/// 0 = object) have gradients in all directions (their structure tensor's smaller eigenvalue): the
/// centre of these gradients. Row by row.
std::vector<Eigen::Vector2f> FindMaskPoints(const FlowPyramid& pyramid, const cv::Mat& mask,
                                            const cv::Rect& box, const MaskPointOptions& options);

}  // namespace ofm
