#include "feature_quality.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <optional>

#include "ofm/features/matching.h"

namespace ofm {
namespace {

constexpr double kTolerance_px = 2.5;
constexpr double kMaxDepth_m = 4;

/// A key point of A that B sees.
struct VisiblePoint {
  int index;                   ///< in A's list
  Eigen::Vector3d point_in_a;  ///< [m]
  Eigen::Vector2d pixel_in_b;  ///< where it should be
};

std::optional<VisiblePoint> FindInB(const PinholeCamera& camera, const RgbdSample& a,
                                    const RgbdSample& b, const Keypoint& keypoint) {
  const Eigen::Vector2d pixel = keypoint.pixel.cast<double>();
  const double depth_m = a.depth_m.at<float>(static_cast<int>(std::lround(pixel.y())),
                                             static_cast<int>(std::lround(pixel.x())));
  if (depth_m <= 0 || depth_m > kMaxDepth_m) return std::nullopt;
  const RigidTransform b_from_a = b.world_from_camera.Inverse() * a.world_from_camera;
  const Eigen::Vector3d in_a = camera.UnprojectIdeal(camera.Undistort(pixel), depth_m);
  const Eigen::Vector3d in_b = b_from_a * in_a;
  if (in_b.z() < 0.1) return std::nullopt;
  const Eigen::Vector2d seen = camera.Project(in_b);
  if (!camera.IsInImage(seen)) return std::nullopt;
  const double measured_m = b.depth_m.at<float>(static_cast<int>(std::lround(seen.y())),
                                                static_cast<int>(std::lround(seen.x())));
  if (measured_m <= 0 || std::abs(measured_m - in_b.z()) > 0.05 * in_b.z()) return std::nullopt;
  return VisiblePoint{0, in_a, seen};
}

double NearestDistance(const std::vector<Keypoint>& keypoints, const Eigen::Vector2d& pixel) {
  double nearest = 1e9;
  for (const Keypoint& keypoint : keypoints) {
    nearest = std::min(nearest, (keypoint.pixel.cast<double>() - pixel).squaredNorm());
  }
  return std::sqrt(nearest);
}

/// Residuals after the pose that fits the matches best: the true pose's own error is larger than
/// that of the key points.
std::vector<double> FittedErrors(const PinholeCamera& camera,
                                 const std::vector<cv::Point3d>& points_in_a,
                                 const std::vector<cv::Point2d>& pixels_in_b) {
  if (points_in_a.size() < 20) return {};
  const cv::Matx33d intrinsics(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const cv::Vec<double, 5> distortion(camera.k1, camera.k2, camera.p1, camera.p2, camera.k3);
  cv::Mat rotation, translation, inliers;
  cv::setRNGSeed(1);
  if (!cv::solvePnPRansac(points_in_a, pixels_in_b, intrinsics, distortion, rotation, translation,
                          false, 200, 3.0F, 0.999, inliers)) {
    return {};
  }
  std::vector<cv::Point2d> projected;
  cv::projectPoints(points_in_a, rotation, translation, intrinsics, distortion, projected);
  std::vector<double> errors;
  for (std::size_t i = 0; i < projected.size(); ++i) {
    errors.push_back(cv::norm(projected[i] - pixels_in_b[i]));
  }
  return errors;
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// Information on (translation, rotation) of one pixel with a noise of `sigma_px`.
Eigen::Matrix<double, 6, 6> Information(const PinholeCamera& camera, const Eigen::Vector3d& point,
                                        double sigma_px) {
  const double z = point.z();
  Eigen::Matrix<double, 2, 3> projection;
  projection << camera.fx / z, 0, -camera.fx * point.x() / (z * z), 0, camera.fy / z,
      -camera.fy * point.y() / (z * z);
  Eigen::Matrix<double, 2, 6> jacobian;
  jacobian << projection, -projection * SkewSymmetric(point);
  return jacobian.transpose() * jacobian / (sigma_px * sigma_px);
}

double PositionSigma_mm(const Eigen::Matrix<double, 6, 6>& information) {
  const Eigen::FullPivLU<Eigen::Matrix<double, 6, 6>> lu(information);
  if (!lu.isInvertible()) return 1e6;
  return 1e3 * std::sqrt(lu.inverse().topLeftCorner<3, 3>().trace());
}

}  // namespace

double FeatureQuality::MedianError_px() const { return Median(errors_px); }
double FeatureQuality::MedianPoseSigma_mm() const { return Median(pose_sigmas_mm); }

void AddPair(const PinholeCamera& camera, const RgbdSample& a, const RgbdSample& b,
             const Features& features_a, const Features& features_b, double scale_factor,
             FeatureQuality& quality) {
  const auto tolerance_px = [&](int index) {
    return kTolerance_px * std::pow(scale_factor, features_a.keypoints[index].octave);
  };
  std::vector<VisiblePoint> visible;
  std::vector<Descriptor> descriptors;
  for (std::size_t i = 0; i < features_a.size(); ++i) {
    auto point = FindInB(camera, a, b, features_a.keypoints[i]);
    if (!point) continue;
    point->index = static_cast<int>(i);
    visible.push_back(*point);
    descriptors.push_back(features_a.descriptors[i]);
    if (NearestDistance(features_b.keypoints, point->pixel_in_b) <= tolerance_px(point->index)) {
      ++quality.repeated;
    }
  }
  quality.visible += static_cast<int>(visible.size());
  ++quality.pairs;
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  const MatchOptions nearest{.max_distance = 256, .max_ratio = 1, .cross_check = true};
  for (const FeatureMatch& match : MatchBruteForce(descriptors, features_b.descriptors, nearest)) {
    const VisiblePoint& point = visible[match.a];
    const Eigen::Vector2d pixel = features_b.keypoints[match.b].pixel.cast<double>();
    ++quality.matches;
    if ((pixel - point.pixel_in_b).norm() > tolerance_px(point.index)) continue;
    ++quality.correct;
    information += Information(camera, point.point_in_a, tolerance_px(point.index) / kTolerance_px);
    points.emplace_back(point.point_in_a.x(), point.point_in_a.y(), point.point_in_a.z());
    pixels.emplace_back(pixel.x(), pixel.y());
  }
  quality.pose_sigmas_mm.push_back(PositionSigma_mm(information));
  for (const double error_px : FittedErrors(camera, points, pixels)) {
    quality.errors_px.push_back(error_px);
  }
}

Extraction OpenCvOrb(int count) {
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(count);
  return [orb](const cv::Mat& gray) {
    std::vector<cv::KeyPoint> keypoints;
    cv::Mat descriptors;
    orb->detectAndCompute(gray, {}, keypoints, descriptors);
    Features features;
    features.descriptors.resize(keypoints.size());
    for (std::size_t i = 0; i < keypoints.size(); ++i) {
      const cv::KeyPoint& k = keypoints[i];
      features.keypoints.push_back({Eigen::Vector2f(k.pt.x, k.pt.y), k.octave,
                                    k.angle * std::numbers::pi_v<float> / 180, k.response});
      std::memcpy(features.descriptors[i].data(), descriptors.ptr(static_cast<int>(i)), 32);
    }
    return features;
  };
}

}  // namespace ofm
