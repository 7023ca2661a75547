// The pinhole model with Brown–Conrady distortion.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>
#include <vector>

#include "ofm/base/options.h"

namespace ofm {

/// Intrinsics of a registered RGB-D camera. Camera axes: x right, y down, z forward [m]. Pixel
/// coordinates have the centre of the upper left pixel at (0, 0). "Ideal" pixels are those of the
/// same camera without distortion; all geometry works on them.
struct PinholeCamera {
  int width = 640, height = 480;                      ///< [px]
  double fx = 525, fy = 525, cx = 319.5, cy = 239.5;  ///< [px]
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;      ///< Brown–Conrady: radial k, tangential p
  double depth_scale = 5000;                          ///< depth image units per metre
  double baseline_m = 0.075;  ///< of the depth sensor; sets its noise and close range
  double depth_delay_s = 0;   ///< of a depth image's stamp behind the moment that it shows

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("width", self.width, "image width [px]", Range{16, 16384});
    visit("height", self.height, "image height [px]", Range{16, 16384});
    visit("fx", self.fx, "focal length in x [px]", Range{1, 1e5});
    visit("fy", self.fy, "focal length in y [px]", Range{1, 1e5});
    visit("cx", self.cx, "principal point in x [px]", Range{0, 16384});
    visit("cy", self.cy, "principal point in y [px]", Range{0, 16384});
    visit("k1", self.k1, "radial distortion r^2");
    visit("k2", self.k2, "radial distortion r^4");
    visit("p1", self.p1, "tangential distortion");
    visit("p2", self.p2, "tangential distortion");
    visit("k3", self.k3, "radial distortion r^6");
    visit("depth_scale", self.depth_scale, "depth image units per metre", Range{1e-3, 1e9});
    visit("baseline_m", self.baseline_m, "baseline of the depth sensor [m]", Range{1e-3, 10});
    visit(
        "depth_delay_s", self.depth_delay_s,
        "of a depth image's stamp behind the moment that it shows, against the colour image's [s]",
        Range{-1, 1});
  }

  /// The point's ideal pixel; its z must not be 0.
  Eigen::Vector2d ProjectIdeal(const Eigen::Vector3d& point_in_camera) const {
    return {fx * point_in_camera.x() / point_in_camera.z() + cx,
            fy * point_in_camera.y() / point_in_camera.z() + cy};
  }
  /// The pixel where the point really appears, distortion included; its z must not be 0.
  Eigen::Vector2d Project(const Eigen::Vector3d& point_in_camera) const;

  /// The point at `depth_m` (its z) behind an ideal pixel.
  Eigen::Vector3d UnprojectIdeal(const Eigen::Vector2d& ideal_px, double depth_m) const {
    return {(ideal_px.x() - cx) / fx * depth_m, (ideal_px.y() - cy) / fy * depth_m, depth_m};
  }

  /// The pixel that the lens makes of an ideal one.
  Eigen::Vector2d Distort(const Eigen::Vector2d& ideal_px) const;
  /// Inverse of Distort by fixed-point iteration, to 1e-6 px where the model is invertible.
  Eigen::Vector2d Undistort(const Eigen::Vector2d& pixel) const;

  bool HasDistortion() const { return k1 != 0 || k2 != 0 || p1 != 0 || p2 != 0 || k3 != 0; }
  bool IsInImage(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= width - 1 && pixel.y() <= height - 1;
  }
};

/// The ideal pixel of every pixel, row by row, computed once; used where whole images are
/// back-projected.
class UndistortionTable {
 public:
  explicit UndistortionTable(const PinholeCamera& camera);
  /// Ideal pixel of (column, row), which must be inside the image.
  const Eigen::Vector2f& At(int column, int row) const { return ideal_px_[row * width_ + column]; }

 private:
  int width_;
  std::vector<Eigen::Vector2f> ideal_px_;
};

/// "tum-fr1", "tum-fr2", "tum-fr3" (the TUM RGB-D benchmark's published intrinsics); empty for
/// another name.
std::optional<PinholeCamera> FindCameraPreset(std::string_view name);

}  // namespace ofm
