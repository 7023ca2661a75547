// The cells that a frame is divided into.
#pragma once

#include "ofm/base/options.h"

namespace ofm {

struct LatticeOptions {
  int cell_px = 4;           ///< side of a cell [px]; even
  double min_depth_m = 0.3;  ///< nearer and farther depth is not used
  double max_depth_m = 5;
  int min_texture = 40;  ///< mean absolute gradient, below which flow is not trusted

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("cell_px", self.cell_px, "side of a cell [px]; even", Range{2, 64});
    visit("min_depth_m", self.min_depth_m, "nearer depth is not used [m]", Range{0, 10});
    visit("max_depth_m", self.max_depth_m, "farther depth is not used [m]", Range{0.1, 100});
    visit("min_texture", self.min_texture, "mean gradient below which flow is not trusted",
          Range{0, 2000});
  }
};

}  // namespace ofm
