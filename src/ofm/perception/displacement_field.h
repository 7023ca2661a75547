// How an object's pixels moved, from a few points on it that were followed.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <vector>

#include "ofm/base/options.h"

namespace ofm {

struct DisplacementOptions {
  double min_tolerance_px = 3;   ///< a point this near to the object's common motion is kept
  double max_tolerance_px = 10;  ///< up to this, where two neighbours do the same: limbs
  int min_points = 4;            ///< fewer that agree give no motion
  double min_share = 0.3;        ///< of the points that must agree
  double reach_px = 40;          ///< how far a point's own motion reaches

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("min_tolerance_px", self.min_tolerance_px,
          "a point this near to the common motion is kept [px]", Range{0, 100});
    visit("max_tolerance_px", self.max_tolerance_px,
          "up to this it is kept where two neighbours do the same [px]", Range{0, 1000});
    visit("min_points", self.min_points, "fewer that agree give no motion", Range{2, 1000});
    visit("min_share", self.min_share, "of the points that must agree", Range{0, 1});
    visit("reach_px", self.reach_px, "how far a point's own motion reaches [px]", Range{1, 1000});
  }
};

/// Points that were followed; the lists have the same length.
struct PointMotion {
  std::vector<Eigen::Vector2f> from, to;  ///< [px]
};

/// A similarity (rotation, scale, shift) that most points agree on, and each point's departure from
/// it, blended over its neighbourhood.
class DisplacementField {
 public:
  /// Empty where too few points agree. Outliers are found by iteratively reweighted least squares
  /// from the median shift (Cauchy weights, scale by the median absolute deviation).
  static std::optional<DisplacementField> Fit(const PointMotion& motion,
                                              const DisplacementOptions& options);

  /// Where the common motion takes `point`.
  Eigen::Vector2f Forward(const Eigen::Vector2f& point) const;

  /// For the middle of every pixel of `region`, whose pixels are `scale` × `scale` image pixels
  /// (region and result are in such pixels), where it came from: CV_32FC2.
  cv::Mat SourceOf(const cv::Rect& region, int scale) const;

  /// Indices into the motion given to Fit.
  const std::vector<std::size_t>& inliers() const { return inliers_; }

  /// Shift [px] of the inliers' centre.
  Eigen::Vector2f mean_shift() const { return to_centre_ - from_centre_; }

 private:
  void FitSimilarity(const PointMotion& motion, std::span<const double> weights);
  Eigen::Vector2f Backward(const Eigen::Vector2f& point) const;

  Eigen::Matrix2f turn_ = Eigen::Matrix2f::Identity();
  Eigen::Vector2f from_centre_ = Eigen::Vector2f::Zero(), to_centre_ = Eigen::Vector2f::Zero();
  float reach_px_ = 1;
  std::vector<std::size_t> inliers_;
  std::vector<Eigen::Vector2f> places_, departures_;  // of the inliers, in the second image
};

}  // namespace ofm
