// Masks that agree with depth.
#pragma once

#include <opencv2/core/mat.hpp>

#include "ofm/base/options.h"

namespace ofm {

struct MaskRefinementOptions {
  double depth_margin_m = 0.33;  ///< around the object's depths; what is farther off is not object
  double region_step_m = 0.05;   ///< between neighbouring pixels of one surface
  int growth_px = 0;  ///< how far a mask grows along the object's surface; more costs accuracy
  double max_growth_share = 0.2;    ///< of the mask's area that is added at most
  double min_part_share = 0.05;     ///< of the largest part; smaller parts are dropped
  int max_hole_px = 400;            ///< pixels of the holes that are closed
  double min_measured_share = 0.2;  ///< with less depth than this a mask stays as it is
  double max_image_share = 0.85;    ///< a mask over more of the image is not believed

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("depth_margin_m", self.depth_margin_m,
          "what is farther than this from the object's depths is trimmed [m]", Range{0, 100});
    visit("region_step_m", self.region_step_m, "depth step between pixels of one surface [m]",
          Range{0, 10});
    visit("growth_px", self.growth_px, "how far a mask grows along the object's surface [px]",
          Range{0, 1000});
    visit("max_growth_share", self.max_growth_share, "of the mask's area that is added at most",
          Range{0, 10});
    visit("min_part_share", self.min_part_share, "of the largest part; smaller ones are dropped",
          Range{0, 1});
    visit("max_hole_px", self.max_hole_px, "pixels of the holes that are closed", Range{0, 1e6});
    visit("min_measured_share", self.min_measured_share,
          "with less depth than this a mask stays as it is", Range{0, 1});
    visit("max_image_share", self.max_image_share, "a mask over more of the image is not believed",
          Range{0, 1});
  }
};

enum class MaskVerdict {
  kRefined,     ///< trimmed and grown
  kUnmeasured,  ///< too little depth: as it was
  kDistrusted,  ///< nearly the whole image: empty
};

struct RefinedMask {
  cv::Mat mask;  ///< CV_8UC1 of the image's size, 255 = object; a new image
  MaskVerdict verdict = MaskVerdict::kRefined;
};

/// Makes `mask` (CV_8UC1, not 0 = object) agree with `depth_m` (CV_32FC1 of its size, 0 = not
/// measured). The object's depths are those of the largest surface in the mask, where neighbours
/// differ by at most region_step_m; other surfaces stay where most of them is within the margin of
/// these depths, so that a person may span more than the margin. What was not measured stays. Then
/// the mask grows along its surfaces. Works at half the resolution. After Ma et al. (NGD-SLAM,
/// 2024) and Bescos et al. (DynaSLAM, 2018).
RefinedMask RefineMask(const cv::Mat& mask, const cv::Mat& depth_m,
                       const MaskRefinementOptions& options);

}  // namespace ofm
