// From a feature to the observation that the estimators take.
#pragma once

#include "ofm/base/options.h"
#include "ofm/camera/pinhole_camera.h"
#include "ofm/estimation/observation.h"
#include "ofm/features/frame_features.h"

namespace ofm {

/// How well features and depth measure.
struct MeasurementOptions {
  double pixel_sigma = 1;  ///< of a feature of octave 0 [px]; grows with the octave's scale
  double inverse_depth_sigma = 0.03;  ///< [1/m]
  double close_baselines = 40;        ///< depth beyond so many baselines makes no landmark

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("pixel_sigma", self.pixel_sigma, "noise of a feature at full scale [px]",
          Range{0.05, 20});
    visit("inverse_depth_sigma", self.inverse_depth_sigma, "noise of inverse depth [1/m]",
          Range{1e-5, 1});
    visit("close_baselines", self.close_baselines,
          "depth beyond so many baselines makes no landmark by itself", Range{1, 1000});
  }
};

/// What is needed to turn features into measurements.
struct MeasurementModel {
  PinholeCamera camera;
  OctaveScales scales;
  MeasurementOptions options;

  /// Depth up to which one measurement makes a landmark [m].
  double CloseDepth() const { return options.close_baselines * camera.baseline_m; }

  PointObservation Observe(const FrameFeatures& frame, int feature) const {
    PointObservation seen;
    seen.ideal_px = frame.ideal_px[feature].cast<double>();
    seen.depth_m = frame.depth_m[feature];
    seen.pixel_sigma = options.pixel_sigma * scales.Scale(frame.keypoints[feature].octave);
    if (frame.IsAligned(feature)) seen.pixel_sigma *= frame.aligned_noise;
    seen.inverse_depth_sigma = options.inverse_depth_sigma * frame.depth_noise;
    seen.weight = frame.StaticProbability(feature);
    return seen;
  }
};

}  // namespace ofm
