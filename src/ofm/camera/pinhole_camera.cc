#include "ofm/camera/pinhole_camera.h"

namespace ofm {

Eigen::Vector2d PinholeCamera::Distort(const Eigen::Vector2d& ideal_px) const {
  const double x = (ideal_px.x() - cx) / fx;
  const double y = (ideal_px.y() - cy) / fy;
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double dx = 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
  const double dy = p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
  return {fx * (x * radial + dx) + cx, fy * (y * radial + dy) + cy};
}

Eigen::Vector2d PinholeCamera::Undistort(const Eigen::Vector2d& pixel) const {
  if (!HasDistortion()) return pixel;
  constexpr int kMaxIterations = 50;
  constexpr double kTolerancePx = 1e-7;
  Eigen::Vector2d ideal = pixel;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Eigen::Vector2d step = pixel - Distort(ideal);
    ideal += step;
    if (step.squaredNorm() < kTolerancePx * kTolerancePx) break;
  }
  return ideal;
}

Eigen::Vector2d PinholeCamera::Project(const Eigen::Vector3d& point_in_camera) const {
  return Distort(ProjectIdeal(point_in_camera));
}

UndistortionTable::UndistortionTable(const PinholeCamera& camera)
    : width_(camera.width), ideal_px_(static_cast<std::size_t>(camera.width) * camera.height) {
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      ideal_px_[row * width_ + column] =
          camera.Undistort(Eigen::Vector2d(column, row)).cast<float>();
    }
  }
}

std::optional<PinholeCamera> FindCameraPreset(std::string_view name) {
  PinholeCamera camera;
  const auto set = [&](double fx, double fy, double cx, double cy) {
    camera.fx = fx, camera.fy = fy, camera.cx = cx, camera.cy = cy;
  };
  const auto distort = [&](double k1, double k2, double p1, double p2, double k3) {
    camera.k1 = k1, camera.k2 = k2, camera.p1 = p1, camera.p2 = p2, camera.k3 = k3;
  };
  if (name == "tum-fr1") {
    set(517.3, 516.5, 318.6, 255.3);
    distort(0.2624, -0.9531, -0.0054, 0.0026, 1.1633);
  } else if (name == "tum-fr2") {
    set(520.9, 521.0, 325.1, 249.7);
    distort(0.2312, -0.7849, -0.0033, -0.0001, 0.9172);
  } else if (name == "tum-fr3") {
    set(535.4, 539.2, 320.1, 247.6);
  } else {
    return {};
  }
  return camera;
}

}  // namespace ofm
