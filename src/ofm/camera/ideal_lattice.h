// A regular grid of viewing rays: images as a camera without distortion would see them, at any
// size.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "ofm/camera/pinhole_camera.h"

namespace ofm {

/// Points `spacing_px` apart in the ideal (undistorted) image plane that cover what the camera sees
/// and a little more. Images sampled on it obey the plain pinhole model, so that geometry on every
/// point is cheap. Immutable.
class IdealLattice {
 public:
  /// `multiple`: columns and rows are rounded up to multiples of it.
  IdealLattice(const PinholeCamera& camera, int spacing_px, int multiple = 1);

  int cols() const { return cols_; }
  int rows() const { return rows_; }
  cv::Size size() const { return {cols_, rows_}; }
  int spacing_px() const { return spacing_px_; }
  /// Ideal pixel of a point of the lattice, and the way back.
  Eigen::Vector2d IdealPx(double column, double row) const {
    return origin_px_ + spacing_px_ * Eigen::Vector2d(column, row);
  }
  Eigen::Vector2d Place(const Eigen::Vector2d& ideal_px) const {
    return (ideal_px - origin_px_) / spacing_px_;
  }
  /// The lattice's own camera: its pixels are the lattice's points, without distortion.
  const PinholeCamera& camera() const { return lattice_camera_; }

  /// Pixels of the camera's image outside of which none is nearest to a point of `points` (columns
  /// and rows of the lattice).
  cv::Rect ImageRect(const cv::Rect& points) const;

  /// Per pixel of the camera's image, the nearest point (column, row). CV_16SC2.
  const cv::Mat& nearest_points() const { return nearest_points_; }

  /// Values of the nearest pixel; 0 where the camera sees nothing.
  cv::Mat SampleNearest(const cv::Mat& image) const;
  /// Means over about a spacing, for grey images; 0 where the camera sees nothing.
  cv::Mat SampleMean(const cv::Mat& image) const;
  /// An image of the camera's size with the value of each pixel's nearest point.
  cv::Mat ToImage(const cv::Mat& lattice_image) const;

 private:
  int spacing_px_;
  int cols_ = 0, rows_ = 0;
  Eigen::Vector2d origin_px_;
  PinholeCamera lattice_camera_;
  cv::Mat image_px_;        // CV_32FC2, per point: where the camera sees it
  cv::Mat image_pixels_;    // CV_16SC2, the same in whole pixels
  cv::Mat reduced_px_;      // the same in an image reduced by the spacing
  cv::Mat nearest_points_;  // CV_16SC2, per pixel of the image: the nearest point
};

}  // namespace ofm
