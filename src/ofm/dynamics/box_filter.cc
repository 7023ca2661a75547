#include "ofm/dynamics/box_filter.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>

#include "ofm/base/check.h"

namespace ofm {
namespace {

constexpr int kMeasured = 5;
using Five = Eigen::Matrix<double, kMeasured, 1>;

Five MeasuredSigmas(const BoxFilterOptions& options) {
  return (Five() << options.centre_px, options.centre_px, options.size_px, options.size_px,
          options.depth_m)
      .finished();
}

Five Accelerations(const BoxFilterOptions& options) {
  return (Five() << options.centre_px_s2, options.centre_px_s2, options.size_px_s2,
          options.size_px_s2, options.depth_m_s2)
      .finished();
}

Five AsVector(const BoxMeasurement& measurement) {
  const cv::Rect& box = measurement.box;
  return (Five() << box.x + 0.5 * box.width, box.y + 0.5 * box.height, box.width, box.height,
          measurement.depth_m.value_or(0))
      .finished();
}

}  // namespace

cv::Rect2d BoxState::Box() const {
  const double width = std::max(1.0, mean(2)), height = std::max(1.0, mean(3));
  return {mean(0) - width / 2, mean(1) - height / 2, width, height};
}

BoxState StartBox(const BoxMeasurement& measurement, const BoxFilterOptions& options) {
  BoxState state;
  state.mean.head<kMeasured>() = AsVector(measurement);
  Five sigmas = MeasuredSigmas(options);
  constexpr double kUnknownDepth_m = 10;
  if (!measurement.depth_m) sigmas(4) = kUnknownDepth_m;
  const Five velocities = (Five() << options.start_px_s, options.start_px_s, options.start_px_s,
                           options.start_px_s, options.start_m_s)
                              .finished();
  state.covariance.diagonal().head<kMeasured>() = sigmas.cwiseAbs2();
  state.covariance.diagonal().tail<kMeasured>() = velocities.cwiseAbs2();
  return state;
}

BoxState PredictBox(const BoxState& state, double interval_s, const BoxFilterOptions& options) {
  OFM_CHECK(interval_s >= 0);
  BoxState::Matrix transition = BoxState::Matrix::Identity();
  transition.topRightCorner<kMeasured, kMeasured>().diagonal().setConstant(interval_s);
  BoxState predicted;
  predicted.mean = transition * state.mean;
  predicted.covariance = transition * state.covariance * transition.transpose();
  // White noise of the acceleration over the interval.
  const Five variance = Accelerations(options).cwiseAbs2();
  const double t2 = interval_s * interval_s;
  for (int i = 0; i < kMeasured; ++i) {
    predicted.covariance(i, i) += variance(i) * t2 * t2 / 4;
    predicted.covariance(i, i + kMeasured) += variance(i) * t2 * interval_s / 2;
    predicted.covariance(i + kMeasured, i) += variance(i) * t2 * interval_s / 2;
    predicted.covariance(i + kMeasured, i + kMeasured) += variance(i) * t2;
  }
  return predicted;
}

BoxState UpdateBox(const BoxState& state, const BoxMeasurement& measurement,
                   const BoxFilterOptions& options) {
  const int count = measurement.depth_m ? kMeasured : kMeasured - 1;
  const Eigen::VectorXd innovation =
      (AsVector(measurement) - state.mean.head<kMeasured>()).head(count);
  const Five variances = MeasuredSigmas(options).cwiseAbs2();
  Eigen::MatrixXd innovation_covariance = state.covariance.topLeftCorner(count, count);
  innovation_covariance.diagonal() += variances.head(count);
  const Eigen::MatrixXd gain =
      innovation_covariance.llt().solve(state.covariance.topRows(count)).transpose();
  BoxState updated;
  updated.mean = state.mean + gain * innovation;
  updated.covariance = state.covariance - gain * state.covariance.topRows(count);
  updated.covariance = (0.5 * (updated.covariance + updated.covariance.transpose())).eval();
  return updated;
}

}  // namespace ofm
