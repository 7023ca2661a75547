// What a structured-light camera (Kinect v1) makes of an ideal image.
#pragma once

#include <cstdint>

#include "ofm/base/options.h"
#include "ofm/camera/pinhole_camera.h"
#include "ofm/sim/renderer.h"

namespace ofm {

enum class NoiseModel {
  kNone,    ///< the ideal image and depth
  kKinect,  ///< all of the below that is not 0
};
EnumNameList<NoiseModel> EnumNames(NoiseModel);

struct SensorNoiseOptions {
  NoiseModel model = NoiseModel::kNone;
  double depth_sigma = 1.4e-3;       ///< sigma = this times z^2, quantisation included [1/m]
  double disparity_step_px = 0.125;  ///< quantisation of the disparity [px]
  double disparity_focal_px = 580;   ///< focal length of the depth sensor [px]
  double min_depth_m = 0.4;          ///< nearer is not measured
  double max_depth_m = 5;            ///< farther is not measured
  double edge_dropout = 0.6;         ///< share of the pixels at depth edges not measured
  double shadow = 0;                 ///< 1: no depth where the projector's light is hidden; 0: off
  double dark_dropout = 0;           ///< share of blocks of 4 px on black surfaces not measured
  double image_sigma = 2;            ///< of each colour channel [grey levels]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("model", self.model, "none or kinect");
    visit("depth_sigma", self.depth_sigma, "standard deviation of depth over depth^2 [1/m]",
          Range{0, 1});
    visit("disparity_step_px", self.disparity_step_px, "quantisation of the disparity, 0 = none",
          Range{0, 10});
    visit("disparity_focal_px", self.disparity_focal_px, "focal length of the depth sensor [px]",
          Range{1, 1e5});
    visit("min_depth_m", self.min_depth_m, "nearest depth measured [m]", Range{0, 100});
    visit("max_depth_m", self.max_depth_m, "farthest depth measured [m]", Range{0, 1000});
    visit("edge_dropout", self.edge_dropout, "share of pixels at depth edges without depth",
          Range{0, 1});
    visit("shadow", self.shadow, "1: no depth where the projector's light is hidden, 0: off",
          Range{0, 1});
    visit("dark_dropout", self.dark_dropout, "share of blocks on black surfaces without depth",
          Range{0, 1});
    visit("image_sigma", self.image_sigma, "of each colour channel [grey levels]", Range{0, 100});
  }
};

/// Makes the noise of a whole sequence: a table of normal deviates drawn once, read from places
/// that the frame decides. The same (options, seed, frame) give the same bytes.
class SensorNoise {
 public:
  SensorNoise(const SensorNoiseOptions& options, const PinholeCamera& camera, std::uint64_t seed);

  /// Changes `image` in place; the instances stay exact.
  void Apply(std::uint32_t frame, RenderedImage& image) const;

 private:
  void DisturbDepth(std::uint32_t frame, cv::Mat& depth_m) const;
  void DisturbColor(std::uint32_t frame, cv::Mat& color) const;
  float Quantise(float depth_m) const;
  void DropShadows(cv::Mat& depth_m) const;
  void DropDark(std::uint32_t frame, const cv::Mat& color, cv::Mat& depth_m) const;

  SensorNoiseOptions options_;
  double baseline_m_, focal_px_;
  std::uint64_t seed_;
  std::vector<float> normal_;  ///< zero mean, unit variance
};

}  // namespace ofm
