// Where a box goes and how it grows: a Kalman filter with constant velocity.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/types.hpp>
#include <optional>

#include "ofm/base/options.h"

namespace ofm {

/// Standard deviations of a box's measurements and of what changes its velocity.
struct BoxFilterOptions {
  double centre_px = 8, size_px = 20;            ///< of a measured box
  double depth_m = 0.1;                          ///< of a measured depth
  double centre_px_s2 = 1500, size_px_s2 = 500;  ///< accelerations in the image
  double depth_m_s2 = 3;                         ///< acceleration along the optical axis
  double start_px_s = 400, start_m_s = 1.5;      ///< velocity of a box not seen before

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("centre_px", self.centre_px, "error of a measured centre [px]", Range{0.1, 1e3});
    visit("size_px", self.size_px, "error of a measured size [px]", Range{0.1, 1e3});
    visit("depth_m", self.depth_m, "error of a measured depth [m]", Range{1e-3, 10});
    visit("centre_px_s2", self.centre_px_s2, "acceleration of the centre [px/s2]", Range{0, 1e6});
    visit("size_px_s2", self.size_px_s2, "acceleration of the size [px/s2]", Range{0, 1e6});
    visit("depth_m_s2", self.depth_m_s2, "acceleration of the depth [m/s2]", Range{0, 1e3});
    visit("start_px_s", self.start_px_s, "velocity of a new box [px/s]", Range{0, 1e5});
    visit("start_m_s", self.start_m_s, "velocity of a new box in depth [m/s]", Range{0, 100});
  }
};

/// What is measured of an object.
struct BoxMeasurement {
  cv::Rect box;                   ///< [px]
  std::optional<double> depth_m;  ///< empty = not measured
};

/// State and covariance: centre x and y, width, height [px], depth [m], and the velocities of these
/// per second. A value.
struct BoxState {
  using Vector = Eigen::Matrix<double, 10, 1>;
  using Matrix = Eigen::Matrix<double, 10, 10>;

  Vector mean = Vector::Zero();
  Matrix covariance = Matrix::Zero();

  Eigen::Vector2d centre_px() const { return mean.head<2>(); }
  double depth_m() const { return mean(4); }  ///< means nothing where it was never measured
  cv::Rect2d Box() const;
};

BoxState StartBox(const BoxMeasurement& measurement, const BoxFilterOptions& options);
BoxState PredictBox(const BoxState& state, double interval_s, const BoxFilterOptions& options);
BoxState UpdateBox(const BoxState& state, const BoxMeasurement& measurement,
                   const BoxFilterOptions& options);

}  // namespace ofm
