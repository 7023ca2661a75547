#include "ofm/tracking/pose_search.h"

#include <cmath>
#include <map>
#include <utility>

#include "ofm/tracking/match_alignment.h"

namespace ofm {

std::optional<CameraEstimate> PoseSearch::FromLastFrame(const TrackingInput& input,
                                                        const TrackedFrame& last,
                                                        const RigidTransform& predicted) const {
  const FrameView view{*input.features, predicted};
  double radius = options_.search_radius_px;
  auto matches = MatchLastFrame(model_, options_, *input.map, last, view, radius);
  if (static_cast<int>(matches.size()) < options_.min_motion_matches) {
    radius *= 2;
    matches = MatchLastFrame(model_, options_, *input.map, last, view, radius);
  }
  if (static_cast<int>(matches.size()) < options_.min_motion_matches) return {};
  auto estimate = Optimize(input, predicted, matches);
  if (!estimate || estimate->map_matches < options_.min_frame_inliers) return {};
  return estimate;
}

std::optional<CameraEstimate> PoseSearch::FromKeyframe(const TrackingInput& input,
                                                       const Keyframe& keyframe,
                                                       int min_inliers) const {
  const auto matches = MatchKeyframe(options_, *input.map, keyframe, *input.features);
  std::vector<PoseObservation> observations;
  for (const PointMatch& match : matches) {
    observations.push_back({match.point_in_world, model_.Observe(*input.features, match.feature)});
  }
  RandomEngine engine = MakeRandomEngine(seed_, input.frame_id.value);
  const auto pose = EstimatePoseRansac(model_.camera, observations, options_.pnp, engine);
  if (!pose || pose->inlier_count < min_inliers) return {};
  CameraEstimate estimate;
  estimate.camera_from_world = pose->camera_from_world;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (pose->inlier[i]) estimate.matches.push_back(matches[i]);
  }
  estimate.map_matches = static_cast<int>(estimate.matches.size());
  return estimate;
}

TrackingResult PoseSearch::InLocalMap(const TrackingInput& input,
                                      const CameraEstimate& estimate) const {
  TrackingResult result;
  result.status = TrackingStatus::kLost;
  result.landmarks.resize(input.features->size());
  const FrameView view{*input.features, estimate.camera_from_world, estimate.near};
  std::vector<PointMatch> matches;
  for (const PointMatch& match : estimate.matches) {
    if (match.landmark.valid()) matches.push_back(match);
  }
  const LocalMapMatches local = MatchLocalMap(model_, options_, *input.map, view, matches);
  std::vector<LandmarkId> looked_for = local.visible;
  for (const PointMatch& match : matches) looked_for.push_back(match.landmark);
  matches.insert(matches.end(), local.matches.begin(), local.matches.end());
  const auto is_enough = [&](const std::optional<CameraEstimate>& found) {
    return found && found->map_matches >= options_.min_map_inliers;
  };
  auto refined = Optimize(input, estimate.camera_from_world, matches);
  TrackingInput placed = input;
  if (options_.alignment.enabled && is_enough(refined)) refined = Align(placed, *refined);
  const auto reference_pose = input.map->FindKeyframePose(local.reference);
  if (!is_enough(refined) || !reference_pose) return result;

  result.status = TrackingStatus::kTracked;
  result.features = placed.features;
  result.inliers = refined->map_matches;
  result.camera_from_world = refined->camera_from_world;
  result.reference = local.reference;
  result.camera_from_reference = result.camera_from_world * reference_pose->Inverse();
  for (const PointMatch& match : refined->matches) result.landmarks[match.feature] = match.landmark;
  result.sightings = MakeSightings(input, *refined, looked_for);
  return result;
}

/// Puts features where alignment with the map finds them, and the camera where these say. Where
/// that comes to nothing, `input` and `estimate` stay as they are.
CameraEstimate PoseSearch::Align(TrackingInput& input, const CameraEstimate& estimate) const {
  const FrameView view{*input.features, estimate.camera_from_world};
  const auto features =
      AlignMatches(model_, options_.alignment.patch, *input.map, view, estimate.matches);
  TrackingInput placed = input;
  placed.features = features;
  const auto first = Optimize(placed, estimate.camera_from_world, estimate.matches);
  if (!first) return estimate;
  const FrameView refined{*features, first->camera_from_world};
  features->aligned_noise = static_cast<float>(
      MeasureAlignedNoise(model_, options_.alignment, refined, estimate.matches));
  features->depth_noise =
      static_cast<float>(MeasureDepthNoise(model_, options_.alignment, refined, estimate.matches));
  const auto second = Optimize(placed, first->camera_from_world, estimate.matches);
  if (!second) return estimate;
  input = std::move(placed);
  return *second;
}

CameraEstimate PoseSearch::EstimateOf(const TrackingInput& input, const TrackingResult& result) {
  CameraEstimate estimate{result.camera_from_world, {}, 0};
  for (std::size_t i = 0; i < result.landmarks.size(); ++i) {
    const Landmark* landmark = input.map->FindLandmark(result.landmarks[i]);
    if (landmark == nullptr) continue;
    estimate.matches.push_back({static_cast<int>(i), landmark->id, landmark->position_in_world});
  }
  estimate.map_matches = static_cast<int>(estimate.matches.size());
  return estimate;
}

std::vector<Sighting> PoseSearch::MakeSightings(const TrackingInput& input,
                                                const CameraEstimate& refined,
                                                const std::vector<LandmarkId>& looked_for) const {
  std::map<LandmarkId, int> found;
  for (const PointMatch& match : refined.matches) found.emplace(match.landmark, match.feature);
  std::vector<Sighting> sightings;
  for (const LandmarkId id : looked_for) {
    const auto feature = found.find(id);
    if (feature != found.end()) {
      sightings.push_back({id, true, input.features->StaticProbability(feature->second)});
    } else {
      const bool moves = IsSeenMoving(input, refined.camera_from_world, id);
      sightings.push_back({id, false, moves ? std::optional(0.0F) : std::nullopt});
    }
  }
  return sightings;
}

std::optional<CameraEstimate> PoseSearch::Optimize(const TrackingInput& input,
                                                   const RigidTransform& initial,
                                                   const std::vector<PointMatch>& matches) const {
  std::vector<PoseObservation> observations;
  observations.reserve(matches.size());
  for (const PointMatch& match : matches) {
    PointObservation seen = model_.Observe(*input.features, match.feature);
    const Landmark* landmark = input.map->FindLandmark(match.landmark);
    if (landmark != nullptr) seen.weight *= landmark->static_probability;
    observations.push_back({match.point_in_world, seen});
  }
  const PoseEstimate pose = OptimizePose(model_.camera, initial, observations, options_.pose);
  if (!pose.converged || !pose.camera_from_world.IsFinite()) return {};
  CameraEstimate estimate;
  estimate.camera_from_world = pose.camera_from_world;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!pose.inlier[i]) continue;
    estimate.matches.push_back(matches[i]);
    estimate.map_matches += matches[i].landmark.valid();
  }
  return estimate;
}

/// True where what moves in the image is as far away as the landmark: it is part of that, and not
/// hidden by it.
bool PoseSearch::IsSeenMoving(const TrackingInput& input, const RigidTransform& camera_from_world,
                              LandmarkId id) const {
  constexpr float kSameDepth_m = 0.15F;
  const Landmark* landmark = input.map->FindLandmark(id);
  if (input.moving_mask.empty() || input.depth_m.empty() || landmark == nullptr) return false;
  const Eigen::Vector3d point = camera_from_world * landmark->position_in_world;
  if (point.z() <= 0) return false;
  const Eigen::Vector2d pixel = model_.camera.Project(point);
  if (!model_.camera.IsInImage(pixel)) return false;
  const cv::Point place(static_cast<int>(std::lround(pixel.x())),
                        static_cast<int>(std::lround(pixel.y())));
  const float depth = input.depth_m.at<float>(place);
  return input.moving_mask.at<std::uint8_t>(place) != 0 && depth > 0 &&
         std::abs(depth - static_cast<float>(point.z())) < kSameDepth_m;
}

}  // namespace ofm
