#include "ofm/perception/displacement_field.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "ofm/base/check.h"

namespace ofm {
namespace {

template <class T>
T Median(std::vector<T> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Eigen::Vector2f MedianShift(const PointMotion& motion) {
  std::vector<float> x, y;
  for (std::size_t i = 0; i < motion.from.size(); ++i) {
    const Eigen::Vector2f shift = motion.to[i] - motion.from[i];
    x.push_back(shift.x());
    y.push_back(shift.y());
  }
  return {Median(std::move(x)), Median(std::move(y))};
}

/// The deviation [px] beyond which a point does not belong to the common motion.
double Tolerance(const std::vector<double>& residuals, const DisplacementOptions& options) {
  constexpr double kSigmasPerMad = 1.4826, kSigmas = 3;
  return std::clamp(kSigmas * kSigmasPerMad * Median(residuals), options.min_tolerance_px,
                    std::max(options.min_tolerance_px, options.max_tolerance_px));
}

/// Departures from the common motion that neighbours share: limbs.
class Limbs {
 public:
  Limbs(const PointMotion& motion, const DisplacementOptions& options,
        const DisplacementField& field)
      : motion_(motion), options_(options) {
    for (std::size_t i = 0; i < motion.from.size(); ++i) {
      departures_.push_back(motion.to[i] - field.Forward(motion.from[i]));
    }
  }

  bool IsShared(std::size_t i) const {
    if (departures_[i].norm() > options_.max_tolerance_px) return false;
    constexpr int kNeeded = 2;
    int alike = 0;
    for (std::size_t k = 0; k < departures_.size() && alike < kNeeded; ++k) {
      if (k == i || (motion_.to[k] - motion_.to[i]).norm() > options_.reach_px) continue;
      if ((departures_[k] - departures_[i]).norm() <= options_.min_tolerance_px / 2) ++alike;
    }
    return alike >= kNeeded;
  }

 private:
  const PointMotion& motion_;
  const DisplacementOptions& options_;
  std::vector<Eigen::Vector2f> departures_;
};

}  // namespace

std::optional<DisplacementField> DisplacementField::Fit(const PointMotion& motion,
                                                        const DisplacementOptions& options) {
  OFM_CHECK(motion.from.size() == motion.to.size());
  const std::size_t count = motion.from.size();
  if (count < static_cast<std::size_t>(options.min_points)) return {};
  DisplacementField field;
  field.reach_px_ = static_cast<float>(options.reach_px);
  field.to_centre_ = MedianShift(motion);
  std::vector<double> residuals(count), weights(count);
  double tolerance = 0;
  constexpr int kIterations = 6;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    for (std::size_t i = 0; i < count; ++i) {
      residuals[i] = (field.Forward(motion.from[i]) - motion.to[i]).norm();
    }
    tolerance = Tolerance(residuals, options);
    if (iteration + 1 == kIterations) break;
    for (std::size_t i = 0; i < count; ++i) {
      const double scaled = 3 * residuals[i] / tolerance;
      weights[i] = 1 / (1 + scaled * scaled);
    }
    field.FitSimilarity(motion, weights);
  }
  const Limbs limbs(motion, options, field);
  for (std::size_t i = 0; i < count; ++i) {
    if (residuals[i] > tolerance && !limbs.IsShared(i)) continue;
    field.inliers_.push_back(i);
    field.places_.push_back(motion.to[i]);
    field.departures_.push_back(motion.from[i] - field.Backward(motion.to[i]));
  }
  const double needed = std::max<double>(options.min_points, options.min_share * count);
  if (static_cast<double>(field.inliers_.size()) < needed) return {};
  return field;
}

void DisplacementField::FitSimilarity(const PointMotion& motion, std::span<const double> weights) {
  double sum = 0;
  Eigen::Vector2d from_centre = Eigen::Vector2d::Zero(), to_centre = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i];
    from_centre += weights[i] * motion.from[i].cast<double>();
    to_centre += weights[i] * motion.to[i].cast<double>();
  }
  from_centre /= sum;
  to_centre /= sum;
  double dot = 0, cross = 0, square = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Eigen::Vector2d p = motion.from[i].cast<double>() - from_centre;
    const Eigen::Vector2d q = motion.to[i].cast<double>() - to_centre;
    dot += weights[i] * p.dot(q);
    cross += weights[i] * (p.x() * q.y() - p.y() * q.x());
    square += weights[i] * p.squaredNorm();
  }
  from_centre_ = from_centre.cast<float>();
  to_centre_ = to_centre.cast<float>();
  turn_.setIdentity();
  // Between two frames nothing doubles its size or turns far; points that say so are wrong, or too
  // close together to tell.
  constexpr double kMinScale = 0.7, kMaxScale = 1.4, kMaxTurn = 0.5;
  if (square < 1) return;
  const double a = dot / square, b = cross / square, scale = std::hypot(a, b);
  if (scale < kMinScale || scale > kMaxScale || std::abs(std::atan2(b, a)) > kMaxTurn) return;
  turn_ << static_cast<float>(a), static_cast<float>(-b), static_cast<float>(b),
      static_cast<float>(a);
}

Eigen::Vector2f DisplacementField::Forward(const Eigen::Vector2f& point) const {
  return to_centre_ + turn_ * (point - from_centre_);
}

Eigen::Vector2f DisplacementField::Backward(const Eigen::Vector2f& point) const {
  return from_centre_ + turn_.inverse() * (point - to_centre_);
}

cv::Mat DisplacementField::SourceOf(const cv::Rect& region, int scale) const {
  OFM_CHECK(!region.empty() && scale > 0);
  // Departures are smooth: worked out on a coarse grid, with a weight of no departure so that they
  // fade away from the points.
  constexpr int kGrid_px = 12;
  constexpr float kPriorWeight = 0.1F;
  const int step = std::max(1, kGrid_px / scale);
  const cv::Size nodes(region.width / step + 2, region.height / step + 2);
  cv::Mat departures(nodes, CV_32FC2);
  const auto image_px = [&](float cell) { return (cell + 0.5F) * scale - 0.5F; };
  for (int j = 0; j < nodes.height; ++j) {
    for (int i = 0; i < nodes.width; ++i) {
      const Eigen::Vector2f node(image_px(static_cast<float>(region.x + i * step)),
                                 image_px(static_cast<float>(region.y + j * step)));
      Eigen::Vector2f sum = Eigen::Vector2f::Zero();
      float weights = kPriorWeight;
      for (std::size_t k = 0; k < places_.size(); ++k) {
        const float square = (places_[k] - node).squaredNorm() / (reach_px_ * reach_px_);
        if (square >= 1) continue;
        const float weight = (1 - square) * (1 - square);
        sum += weight * departures_[k];
        weights += weight;
      }
      sum /= weights;
      departures.at<cv::Vec2f>(j, i) = {sum.x(), sum.y()};
    }
  }
  cv::Mat source(region.size(), CV_32FC2);
  const Eigen::Matrix2f back = turn_.inverse();
  for (int y = 0; y < region.height; ++y) {
    auto* row = source.ptr<cv::Vec2f>(y);
    const int j = y / step;
    const float v = static_cast<float>(y - j * step) / static_cast<float>(step);
    const auto* upper = departures.ptr<cv::Vec2f>(j);
    const auto* lower = departures.ptr<cv::Vec2f>(j + 1);
    for (int x = 0; x < region.width; ++x) {
      const int i = x / step;
      const float u = static_cast<float>(x - i * step) / static_cast<float>(step);
      const cv::Vec2f departure = (1 - v) * ((1 - u) * upper[i] + u * upper[i + 1]) +
                                  v * ((1 - u) * lower[i] + u * lower[i + 1]);
      const Eigen::Vector2f place(image_px(static_cast<float>(region.x + x)),
                                  image_px(static_cast<float>(region.y + y)));
      const Eigen::Vector2f origin = from_centre_ + back * (place - to_centre_);
      row[x] = {origin.x() + departure[0], origin.y() + departure[1]};
    }
  }
  return source;
}

}  // namespace ofm
