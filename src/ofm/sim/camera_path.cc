#include "ofm/sim/camera_path.h"

#include <array>
#include <cmath>
#include <numbers>

#include "ofm/base/check.h"

namespace ofm {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

/// Three incommensurate waves between -1 and 1, all 0 at time 0.
Eigen::Vector3d Waves(double time_s, double period_s) {
  const double angle = 2 * std::numbers::pi * time_s / period_s;
  return {std::sin(1.37 * angle), std::sin(1.71 * angle), std::sin(angle)};
}

}  // namespace

EnumNameList<CameraPathKind> EnumNames(CameraPathKind) {
  static constexpr std::array<std::pair<CameraPathKind, std::string_view>, 5> kNames = {
      {{CameraPathKind::kStatic, "static"},
       {CameraPathKind::kXyz, "xyz"},
       {CameraPathKind::kRpy, "rpy"},
       {CameraPathKind::kHalfsphere, "halfsphere"},
       {CameraPathKind::kTour, "tour"}}};
  return kNames;
}

RigidTransform LookAt(const Eigen::Vector3d& eye_in_world, const Eigen::Vector3d& target_in_world) {
  const Eigen::Vector3d forward = (target_in_world - eye_in_world).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ());
  OFM_CHECK(right.norm() > 1e-6);
  Eigen::Matrix3d world_from_camera;
  world_from_camera.col(0) = right.normalized();
  world_from_camera.col(1) = forward.cross(right.normalized());
  world_from_camera.col(2) = forward;
  return {world_from_camera, eye_in_world};
}

CameraPath::CameraPath(const CameraPathOptions& options, const Viewpoint& viewpoint)
    : options_(options), viewpoint_(viewpoint) {
  if (!viewpoint.tour_in_world.empty()) tour_.emplace(viewpoint.tour_in_world);
}

RigidTransform CameraPath::Xyz(double time_s) const {
  const RigidTransform middle = LookAt(viewpoint_.eye_in_world, viewpoint_.target_in_world);
  const Eigen::Vector3d shift = options_.amplitude_m * Waves(time_s, options_.period_s);
  return {middle.rotation(), middle * shift};
}

RigidTransform CameraPath::Rpy(double time_s) const {
  constexpr double kSway_m = 0.02;  // a hand that turns a camera does not hold it in place
  const RigidTransform middle = LookAt(viewpoint_.eye_in_world, viewpoint_.target_in_world);
  const Eigen::Vector3d waves = Waves(time_s, options_.period_s);
  const Eigen::Vector3d angles = options_.amplitude_deg * kRadiansPerDegree * waves;
  return middle * RigidTransform(ExpSo3(angles), kSway_m * Waves(time_s, 0.8 * options_.period_s));
}

RigidTransform CameraPath::Halfsphere(double time_s) const {
  constexpr double kElevationSpan = 0.3;  // of the azimuth's
  const Eigen::Vector3d arm = viewpoint_.eye_in_world - viewpoint_.target_in_world;
  const double radius = arm.norm();
  const Eigen::Vector3d waves = Waves(time_s, 2 * options_.period_s);  // a long way: slowly
  const double span = 2 * options_.amplitude_deg * kRadiansPerDegree;
  const double azimuth = std::atan2(arm.y(), arm.x()) + span * waves.z();
  const double elevation = std::asin(arm.z() / radius) + kElevationSpan * span * waves.x();
  const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  return LookAt(viewpoint_.target_in_world + radius * direction, viewpoint_.target_in_world);
}

RigidTransform CameraPath::Tour(double time_s) const {
  if (tour_) {
    constexpr double kAhead_m = 1.1, kSink_m = 0.12;
    const double gone_m = options_.tour_speed_mps * time_s;
    const Eigen::Vector2d here = tour_->At(gone_m), ahead = tour_->At(gone_m + kAhead_m);
    const double height_m = viewpoint_.eye_in_world.z();
    return LookAt({here.x(), here.y(), height_m}, {ahead.x(), ahead.y(), height_m - kSink_m});
  }
  constexpr double kRadiusPerAmplitude = 5;
  constexpr double kPeriodsPerRound = 4;
  constexpr double kBob_m = 0.05;
  const double period_s = kPeriodsPerRound * options_.period_s;
  const double angle = 2 * std::numbers::pi * time_s / period_s;
  const Eigen::Vector3d view = viewpoint_.target_in_world - viewpoint_.eye_in_world;
  const double azimuth = std::atan2(view.y(), view.x()) + angle;
  const Eigen::Vector3d outwards(std::cos(azimuth), std::sin(azimuth), 0);
  const Eigen::Vector3d eye =
      kRadiusPerAmplitude * options_.amplitude_m * outwards +
      (viewpoint_.eye_in_world.z() + kBob_m * std::sin(3 * angle)) * Eigen::Vector3d::UnitZ();
  return LookAt(eye, eye + outwards - 0.12 * Eigen::Vector3d::UnitZ());
}

RigidTransform CameraPath::Jitter(double time_s) const {
  // Sums of waves without a common period, about as a hand trembles (0.5 to 4 Hz).
  const auto tremor = [time_s](double start) {
    return 0.5 * std::sin(3.9 * time_s + 1.3 * start) + 0.3 * std::sin(9.7 * time_s + 2.9 * start) +
           0.2 * std::sin(23.3 * time_s + 4.1 * start);
  };
  const Eigen::Vector3d shift(tremor(1), tremor(2), tremor(3));
  const Eigen::Vector3d turn(tremor(4), tremor(5), tremor(6));
  return {ExpSo3(options_.jitter_deg * kRadiansPerDegree * turn), options_.jitter_m * shift};
}

RigidTransform CameraPath::WorldFromCamera(double time_s) const {
  if (options_.jitter_m == 0 && options_.jitter_deg == 0) return Steady(time_s);
  return Steady(time_s) * Jitter(time_s);
}

RigidTransform CameraPath::Steady(double time_s) const {
  switch (options_.kind) {
    case CameraPathKind::kStatic:
      return LookAt(viewpoint_.eye_in_world, viewpoint_.target_in_world);
    case CameraPathKind::kXyz:
      return Xyz(time_s);
    case CameraPathKind::kRpy:
      return Rpy(time_s);
    case CameraPathKind::kHalfsphere:
      return Halfsphere(time_s);
    case CameraPathKind::kTour:
      return Tour(time_s);
  }
  OFM_CHECK(false);
  return {};
}

}  // namespace ofm
