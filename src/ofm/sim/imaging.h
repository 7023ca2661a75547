// What a real camera's shutter does to the colour image.
#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>

#include "ofm/base/options.h"

namespace ofm {

struct ImagingOptions {
  double exposure_s = 0;  ///< the shutter is open that long about a frame's stamp [s]; 0 = no blur
  double sub_frame_px = 2;  ///< least motion within one of the sharp images that make a blurred one
  int max_sub_frames = 6;   ///< at most so many sharp images
  double exposure_swing = 0;  ///< brightness goes up and down by so many stops

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("exposure_s", self.exposure_s, "time that the shutter is open: motion blur, 0 = none [s]",
          Range{0, 1});
    visit("sub_frame_px", self.sub_frame_px,
          "motion between the images that make a blurred one [px]", Range{0.1, 100});
    visit("max_sub_frames", self.max_sub_frames, "images that make a blurred one, at most",
          Range{1, 100});
    visit("exposure_swing", self.exposure_swing, "brightness goes up and down by that [stops]",
          Range{0, 5});
  }
};

/// The mean of sharp images (CV_8UC3) over the time that the shutter is open about `time_s`, one
/// for each sub_frame_px of `speed_px_per_s`, which is the fastest motion to be expected.
cv::Mat BlurByMotion(const ImagingOptions& options, double time_s, double speed_px_per_s,
                     const std::function<cv::Mat(double time_s)>& render);

/// Makes a colour image brighter or darker, slowly over time, as automatic exposure does.
void ChangeExposure(const ImagingOptions& options, double time_s, cv::Mat& color);

}  // namespace ofm
