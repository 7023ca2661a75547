#include "ofm/camera/ideal_lattice.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "ofm/base/check.h"

namespace ofm {
namespace {

struct Bounds {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9), high = Eigen::Vector2d::Constant(-1e9);

  void Add(const Eigen::Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

/// What the ideal image must span to show every pixel, but no more than a quarter beyond the image:
/// a strong lens model may run away at its corners.
Bounds IdealBounds(const PinholeCamera& camera) {
  Bounds bounds;
  const auto add = [&](const Eigen::Vector2d& pixel) {
    const Eigen::Vector2d ideal_px = camera.Undistort(pixel);
    bounds.Add(ideal_px.allFinite() ? ideal_px : pixel);
  };
  constexpr int kStep = 8;
  for (int x = 0; x < camera.width + kStep; x += kStep) {
    const double column = std::min(x, camera.width - 1);
    add({column, 0.0});
    add({column, camera.height - 1.0});
  }
  for (int y = 0; y < camera.height + kStep; y += kStep) {
    const double row = std::min(y, camera.height - 1);
    add({0.0, row});
    add({camera.width - 1.0, row});
  }
  const Eigen::Vector2d size(camera.width, camera.height);
  bounds.low = bounds.low.cwiseMax(-size / 4);
  bounds.high = bounds.high.cwiseMin(size + size / 4);
  return bounds;
}

int CountPoints(double extent_px, int spacing_px, int multiple) {
  const int count = static_cast<int>(std::ceil((extent_px + 1) / spacing_px));
  return (count + multiple - 1) / multiple * multiple;
}

PinholeCamera MakeLatticeCamera(const PinholeCamera& camera, const IdealLattice& lattice) {
  PinholeCamera result = camera;
  const Eigen::Vector2d principal = lattice.Place({camera.cx, camera.cy});
  result.width = lattice.cols();
  result.height = lattice.rows();
  result.fx = camera.fx / lattice.spacing_px();
  result.fy = camera.fy / lattice.spacing_px();
  result.cx = principal.x();
  result.cy = principal.y();
  result.k1 = result.k2 = result.p1 = result.p2 = result.k3 = 0;
  return result;
}

}  // namespace

IdealLattice::IdealLattice(const PinholeCamera& camera, int spacing_px, int multiple)
    : spacing_px_(spacing_px) {
  OFM_CHECK(spacing_px >= 1 && multiple >= 1);
  const Bounds bounds = IdealBounds(camera);
  const Eigen::Vector2d extent = bounds.high - bounds.low;
  cols_ = CountPoints(extent.x(), spacing_px, multiple);
  rows_ = CountPoints(extent.y(), spacing_px, multiple);
  // Each point stands for the spacing × spacing pixels around it.
  origin_px_ = bounds.low + Eigen::Vector2d::Constant((spacing_px - 1) / 2.0);
  lattice_camera_ = MakeLatticeCamera(camera, *this);

  image_px_.create(rows_, cols_, CV_32FC2);
  reduced_px_.create(rows_, cols_, CV_32FC2);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < cols_; ++column) {
      const Eigen::Vector2f px = camera.Distort(IdealPx(column, row)).cast<float>();
      image_px_.at<cv::Point2f>(row, column) = {px.x(), px.y()};
      const Eigen::Vector2f reduced = (px.array() + 0.5F) / static_cast<float>(spacing_px) - 0.5F;
      reduced_px_.at<cv::Point2f>(row, column) = {reduced.x(), reduced.y()};
    }
  }
  cv::Mat nothing;
  cv::convertMaps(image_px_, cv::noArray(), image_pixels_, nothing, CV_16SC2, true);
  nearest_points_.create(camera.height, camera.width, CV_16SC2);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector2d place = Place(camera.Undistort({x, y}));
      nearest_points_.at<cv::Vec2s>(y, x) = {
          static_cast<short>(std::clamp<long>(std::lround(place.x()), 0, cols_ - 1)),
          static_cast<short>(std::clamp<long>(std::lround(place.y()), 0, rows_ - 1))};
    }
  }
}

cv::Rect IdealLattice::ImageRect(const cv::Rect& points) const {
  const cv::Rect lattice({}, size()), image({}, nearest_points_.size());
  const cv::Rect known = points & lattice;
  if (known.empty()) return {};
  // What the outermost points see ends the image.
  const auto column = [&](int x) { return std::clamp(x, 0, cols_ - 1); };
  const auto row = [&](int y) { return std::clamp(y, 0, rows_ - 1); };
  const int left = known.x - 1, top = known.y - 1, right = known.br().x, bottom = known.br().y;
  cv::Point2f low(1e9F, 1e9F), high(-1e9F, -1e9F);
  const auto add = [&](int x, int y) {
    const auto& p = image_px_.at<cv::Point2f>(row(y), column(x));
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  };
  for (int x = left; x <= right; ++x) {
    add(x, top);
    add(x, bottom);
  }
  for (int y = top; y <= bottom; ++y) {
    add(left, y);
    add(right, y);
  }
  const cv::Point from(left < 0 ? 0 : cvFloor(low.x), top < 0 ? 0 : cvFloor(low.y));
  const cv::Point to(right >= cols_ ? image.width : cvCeil(high.x) + 1,
                     bottom >= rows_ ? image.height : cvCeil(high.y) + 1);
  return cv::Rect(from, to) & image;
}

cv::Mat IdealLattice::SampleNearest(const cv::Mat& image) const {
  cv::Mat result;
  cv::remap(image, result, image_pixels_, cv::noArray(), cv::INTER_NEAREST, cv::BORDER_CONSTANT);
  return result;
}

cv::Mat IdealLattice::SampleMean(const cv::Mat& image) const {
  cv::Mat reduced, result;
  cv::resize(image, reduced, {}, 1.0 / spacing_px_, 1.0 / spacing_px_, cv::INTER_AREA);
  cv::remap(reduced, result, reduced_px_, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  return result;
}

cv::Mat IdealLattice::ToImage(const cv::Mat& lattice_image) const {
  OFM_CHECK(lattice_image.size() == size());
  cv::Mat result;
  cv::remap(lattice_image, result, nearest_points_, cv::noArray(), cv::INTER_NEAREST);
  return result;
}

}  // namespace ofm
