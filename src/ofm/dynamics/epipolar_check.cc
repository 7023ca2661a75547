#include "ofm/dynamics/epipolar_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "ofm/base/check.h"

namespace ofm {
namespace {

using CvPoints = std::vector<cv::Point2d>;

CvPoints Convert(const std::vector<Eigen::Vector2d>& points) {
  CvPoints converted;
  converted.reserve(points.size());
  for (const Eigen::Vector2d& point : points) converted.emplace_back(point.x(), point.y());
  return converted;
}

CvPoints Select(const CvPoints& points, const std::vector<std::uint8_t>& chosen) {
  CvPoints selected;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (chosen[i] != 0) selected.push_back(points[i]);
  }
  return selected;
}

bool IsFundamental(const cv::Mat& matrix) {
  return matrix.rows == 3 && matrix.cols == 3 && matrix.type() == CV_64F && cv::checkRange(matrix);
}

}  // namespace

std::optional<FundamentalFit> FitFundamental(const PointPairs& pairs,
                                             const EpipolarOptions& options) {
  OFM_CHECK(pairs.first.size() == pairs.second.size());
  constexpr std::size_t kEightPoint = 8;
  if (pairs.size() < std::max(kEightPoint, static_cast<std::size_t>(options.min_points))) return {};
  const CvPoints first = Convert(pairs.first), second = Convert(pairs.second);
  try {
    // OpenCV's RANSAC draws from an engine of its own with a fixed seed.
    std::vector<std::uint8_t> is_inlier;
    const cv::Mat sampled =
        cv::findFundamentalMat(first, second, cv::FM_RANSAC, options.ransac_threshold_px,
                               options.ransac_confidence, options.ransac_iterations, is_inlier);
    if (!IsFundamental(sampled)) return {};
    const auto inliers =
        static_cast<std::size_t>(std::count(is_inlier.begin(), is_inlier.end(), 1));
    const auto needed = static_cast<double>(pairs.size()) * options.min_inlier_share;
    if (inliers < kEightPoint || static_cast<double>(inliers) < needed) return {};

    const cv::Mat refined =
        cv::findFundamentalMat(Select(first, is_inlier), Select(second, is_inlier), cv::FM_8POINT);
    const cv::Mat& best = IsFundamental(refined) ? refined : sampled;
    // OpenCV stores rows, Eigen columns.
    return FundamentalFit{Eigen::Map<const Eigen::Matrix3d>(best.ptr<double>()).transpose(),
                          inliers};
  } catch (const cv::Exception&) {
    return {};  // a numeric breakdown in a degenerate configuration
  }
}

double EpipolarDistance(const Eigen::Matrix3d& fundamental, const Eigen::Vector2d& first,
                        const Eigen::Vector2d& second) {
  const Eigen::Vector3d line = fundamental * first.homogeneous();
  const double norm = line.head<2>().norm();
  return norm > 0 ? std::abs(second.homogeneous().dot(line)) / norm : 0;
}

}  // namespace ofm
