#include "ofm/tracking/match_alignment.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "ofm/base/median.h"

namespace ofm {
namespace {

/// Fewer residuals say nothing of the noise.
constexpr std::size_t kLeastResiduals = 20;

/// A landmark's feature in the keyframe that made it.
struct Origin {
  const Keyframe& keyframe;
  int feature;
  double depth_m;  ///< of the landmark
};

/// By the keyframe that made the landmark, or else the oldest that sees it and has patches; empty
/// where none has.
std::optional<Origin> FindOrigin(const MapSnapshot& map, LandmarkId id) {
  const Landmark* landmark = map.FindLandmark(id);
  if (landmark == nullptr) return {};
  const Keyframe* oldest = nullptr;
  int feature = -1;
  for (const Landmark::Observation& o : landmark->observations) {
    const bool made_it = o.keyframe == landmark->first_keyframe;
    if (oldest != nullptr && !made_it) continue;
    const Keyframe* keyframe = map.keyframes.Find(o.keyframe);
    if (keyframe == nullptr || keyframe->features->patches == nullptr) continue;
    oldest = keyframe, feature = o.feature;
    if (made_it) break;
  }
  if (oldest == nullptr) return {};
  const double depth_m = (oldest->camera_from_world * landmark->position_in_world).z();
  if (depth_m <= 0) return {};
  return Origin{*oldest, feature, depth_m};
}

/// How small offsets from a pixel of the keyframe appear in the other view (2 x 2, full images),
/// the surface facing the keyframe.
Eigen::Matrix2d LinearWarp(const PinholeCamera& camera, const Origin& origin,
                           const RigidTransform& view_from_origin) {
  constexpr double kStep_px = 4;
  const Eigen::Vector2d place = origin.keyframe.features->ideal_px[origin.feature].cast<double>();
  const auto seen = [&](const Eigen::Vector2d& pixel) {
    return camera.ProjectIdeal(view_from_origin * camera.UnprojectIdeal(pixel, origin.depth_m));
  };
  Eigen::Matrix2d warp;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d step = kStep_px * Eigen::Vector2d::Unit(axis);
    warp.col(axis) = (seen(place + step) - seen(place - step)) / (2 * kStep_px);
  }
  return warp;
}

/// A feature's place in its patch.
PatchPlace PlaceOf(const MeasurementModel& model, const FrameFeatures& frame, int feature) {
  const ImagePatch& patch = (*frame.patches)[feature];
  const Keypoint& keypoint = frame.keypoints[feature];
  return {patch, (keypoint.pixel - patch.centre_px) / model.scales.Scale(keypoint.octave)};
}

/// Where in the full image the feature is to be; empty where it should stay.
std::optional<Eigen::Vector2f> FindPlace(const MeasurementModel& model,
                                         const PatchAlignmentOptions& options, const Origin& origin,
                                         const FrameView& view, int feature) {
  const RigidTransform view_from_origin =
      view.camera_from_world * origin.keyframe.camera_from_world.Inverse();
  const Eigen::Matrix2d warp = LinearWarp(model.camera, origin, view_from_origin);
  if (!warp.allFinite() || warp.determinant() <= 0) return {};
  const FrameFeatures& before = *origin.keyframe.features;
  const float scale = model.scales.Scale(view.features.keypoints[feature].octave);
  const float scale_before = model.scales.Scale(before.keypoints[origin.feature].octave);
  const PatchPlace current = PlaceOf(model, view.features, feature);
  const auto offset = AlignPatch(PlaceOf(model, before, origin.feature), current,
                                 warp.inverse().cast<float>() * (scale / scale_before), options);
  if (!offset) return {};
  return current.patch.centre_px + scale * *offset;
}

/// Sigma of residuals, of which `unit_median` is the median where sigma is 1; empty for too few.
std::optional<double> RobustSigma(std::vector<double> residuals, double unit_median) {
  if (residuals.size() < kLeastResiduals) return {};
  return UpperMedian(std::move(residuals)) / unit_median;
}

}  // namespace

std::shared_ptr<FrameFeatures> AlignMatches(const MeasurementModel& model,
                                            const PatchAlignmentOptions& options,
                                            const MapSnapshot& map, const FrameView& view,
                                            std::span<const PointMatch> matches) {
  auto aligned = std::make_shared<FrameFeatures>(view.features);
  aligned->is_aligned.assign(view.features.size(), 0);
  if (view.features.patches == nullptr) return aligned;
  for (const PointMatch& match : matches) {
    const auto origin = FindOrigin(map, match.landmark);
    if (!origin) continue;
    const auto pixel = FindPlace(model, options, *origin, view, match.feature);
    if (!pixel) continue;
    aligned->keypoints[match.feature].pixel = *pixel;
    aligned->ideal_px[match.feature] = model.camera.Undistort(pixel->cast<double>()).cast<float>();
    aligned->is_aligned[match.feature] = 1;
  }
  aligned->grid = FeatureGrid(aligned->ideal_px, model.camera.width, model.camera.height);
  return aligned;
}

double MeasureAlignedNoise(const MeasurementModel& model, const MatchAlignmentOptions& options,
                           const FrameView& view, std::span<const PointMatch> matches) {
  constexpr double kMedianOfRayleigh = 1.1774;  // of the length of a residual of sigma 1 per axis
  std::vector<double> residuals;
  for (const PointMatch& match : matches) {
    if (!view.features.IsAligned(match.feature)) continue;
    const Eigen::Vector3d in_camera = view.camera_from_world * match.point_in_world;
    if (in_camera.z() <= 0) continue;
    const Eigen::Vector2d seen = view.features.ideal_px[match.feature].cast<double>();
    const double sigma_px = model.options.pixel_sigma *
                            model.scales.Scale(view.features.keypoints[match.feature].octave);
    residuals.push_back((model.camera.ProjectIdeal(in_camera) - seen).norm() / sigma_px);
  }
  const auto sigma = RobustSigma(std::move(residuals), kMedianOfRayleigh);
  if (!sigma) return 1;
  return std::clamp(options.noise_scale * *sigma, options.min_noise, 1.0);
}

double MeasureDepthNoise(const MeasurementModel& model, const MatchAlignmentOptions& options,
                         const FrameView& view, std::span<const PointMatch> matches) {
  constexpr double kMedianOfNormal = 0.6745;  // of the absolute value of a residual of sigma 1
  std::vector<double> residuals;
  for (const PointMatch& match : matches) {
    const double depth_m = view.features.depth_m[match.feature];
    const double expected_m = (view.camera_from_world * match.point_in_world).z();
    if (depth_m <= 0 || expected_m <= 0) continue;
    residuals.push_back(std::abs(1 / depth_m - 1 / expected_m) / model.options.inverse_depth_sigma);
  }
  const auto sigma = RobustSigma(std::move(residuals), kMedianOfNormal);
  if (!sigma) return 1;
  const double distrust = view.features.aligned_noise / options.min_noise - 1;
  return std::clamp(std::max(options.depth_noise_scale * *sigma, distrust), options.min_depth_noise,
                    1.0);
}

}  // namespace ofm
