// How well features of two views of a static scene find one another, by true depth and poses.
#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "ofm/features/features.h"
#include "rgbd_samples.h"

namespace ofm {

using Extraction = std::function<Features(const cv::Mat& gray)>;

/// Sums over image pairs.
struct FeatureQuality {
  int visible = 0;   ///< key points of A that B sees
  int repeated = 0;  ///< of these, with a key point of B within 2.5 px x scale
  int matches = 0;   ///< mutual nearest descriptors among the visible ones and all of B
  int correct = 0;   ///< of these, within 2.5 px x scale
  int pairs = 0;
  std::vector<double> errors_px;  ///< of the correct ones, after the best pose between the views

  std::vector<double> pose_sigmas_mm;  ///< of the camera's place by the correct ones, 1 px x scale

  double MedianPoseSigma_mm() const;
  double Repeatability() const { return visible ? 1.0 * repeated / visible : 0; }
  double CorrectRatio() const { return matches ? 1.0 * correct / matches : 0; }
  double CorrectPerPair() const { return pairs ? 1.0 * correct / pairs : 0; }
  double MedianError_px() const;
};

/// Adds the pair (a, b). `scale_factor` is that of the octaves.
void AddPair(const PinholeCamera& camera, const RgbdSample& a, const RgbdSample& b,
             const Features& features_a, const Features& features_b, double scale_factor,
             FeatureQuality& quality);

/// cv::ORB's features as ours. `count` key points, its defaults otherwise.
Extraction OpenCvOrb(int count);

}  // namespace ofm
