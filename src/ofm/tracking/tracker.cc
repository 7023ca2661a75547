#include "ofm/tracking/tracker.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "ofm/base/time.h"
#include "ofm/map/covisibility.h"
#include "ofm/tracking/keyframe_decision.h"

namespace ofm {

/// A pose with the matches that agree with it.
struct Tracker::Estimate {
  RigidTransform camera_from_world;
  std::vector<PointMatch> matches;  // inliers only
  int map_matches = 0;              // of these, how many show a landmark
};

Tracker::Tracker(const MeasurementModel& model, const TrackingOptions& options, std::uint64_t seed)
    : model_(model), options_(options), seed_(seed) {}

TrackingResult Tracker::Process(const TrackingInput& input) {
  if (input.map == nullptr || input.map->keyframe_count == 0) {
    TrackingResult result = Initialize(input);
    Remember(input, result);
    return result;
  }
  SyncWithMap(*input.map);
  TrackingResult result = TrackOrRelocalize(AlignDepth(input, velocity_));
  // Once more with the motion that was found: the predicted one is not good enough for landmarks.
  const TrackingInput aligned = AlignDepth(input, VelocityTo(input, result));
  if (HasPose(result.status) &&
      NeedsKeyframe(GatherKeyframeEvidence(model_, aligned, result, last_keyframe_frame_),
                    options_.keyframe)) {
    result.keyframe = KeyframeCandidate{input.frame_id,
                                        input.stamp_ns,
                                        result.camera_from_world,
                                        result.reference,
                                        result.camera_from_reference,
                                        aligned.features,
                                        result.landmarks};
  }
  Remember(aligned, result);
  return result;
}

/// The input with the depth of its features as it was at the time of the colour image, the camera
/// moving with `velocity`.
TrackingInput Tracker::AlignDepth(const TrackingInput& input,
                                  const std::optional<Vector6d>& velocity) const {
  TrackingInput aligned = input;
  const double delay_s = NanosecondsToSeconds(input.depth_stamp_ns - input.stamp_ns);
  if (velocity && !input.depth_m.empty() && delay_s != 0) {
    aligned.features = AlignDepthInTime(*input.features, input.depth_m, ExpSe3(delay_s * *velocity),
                                        model_.camera);
  }
  return aligned;
}

/// Twist per second from the last frame to this one; empty where either has no pose.
std::optional<Vector6d> Tracker::VelocityTo(const TrackingInput& input,
                                            const TrackingResult& result) const {
  if (!HasPose(result.status) || !last_ || input.stamp_ns <= last_->stamp_ns) return {};
  const double elapsed_s = NanosecondsToSeconds(input.stamp_ns - last_->stamp_ns);
  return LogSe3(result.camera_from_world * last_->camera_from_world.Inverse()) / elapsed_s;
}

/// Follows the last frame; where that fails or leaves few inliers, the reference keyframe is asked
/// too, by descriptors alone, and the better of the two answers counts.
TrackingResult Tracker::TrackOrRelocalize(const TrackingInput& input) const {
  TrackingResult best;
  best.status = TrackingStatus::kLost;
  best.landmarks.resize(input.features->size());
  const auto consider = [&](const std::optional<Estimate>& estimate) {
    if (!estimate) return;
    TrackingResult result = TrackLocalMap(input, *estimate);
    if (HasPose(result.status) && result.inliers > best.inliers) best = std::move(result);
  };
  if (last_) {
    consider(TrackFromLastFrame(input));
    const Keyframe* reference = input.map->keyframes.Find(reference_);
    if (reference != nullptr && best.inliers < options_.doubtful_share * last_inliers_) {
      consider(TrackFromKeyframe(input, *reference, options_.min_frame_inliers));
    }
  }
  if (!HasPose(best.status)) {
    consider(Relocalize(input));
    if (HasPose(best.status)) best.status = TrackingStatus::kRelocalized;
  }
  return best;
}

TrackingResult Tracker::Initialize(const TrackingInput& input) const {
  TrackingResult result;
  result.landmarks.resize(input.features->size());
  const auto has_depth = [](float depth) { return depth > 0; };
  const auto& depth = input.features->depth_m;
  if (std::count_if(depth.begin(), depth.end(), has_depth) < options_.min_start_features) {
    return result;
  }
  result.status = TrackingStatus::kInitialized;
  KeyframeCandidate candidate;
  candidate.frame_id = input.frame_id;
  candidate.stamp_ns = input.stamp_ns;
  candidate.features = input.features;
  candidate.landmarks = result.landmarks;
  result.keyframe = std::move(candidate);
  return result;
}

/// Brings what is remembered of the last frame up to date with what mapping did since.
void Tracker::SyncWithMap(const MapSnapshot& map) {
  if (!last_) return;
  const Keyframe* latest = map.keyframes.Find(map.latest_keyframe);
  if (latest != nullptr && latest->frame_id == last_->id) {
    reference_ = latest->id;
    camera_from_reference_ = RigidTransform();
    last_->landmarks = latest->landmarks;
  }
  const auto reference_pose = map.FindKeyframePose(reference_);
  if (reference_pose) last_->camera_from_world = camera_from_reference_ * *reference_pose;
}

std::optional<Tracker::Estimate> Tracker::OptimizeMatches(
    const TrackingInput& input, const RigidTransform& initial,
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
  Estimate estimate;
  estimate.camera_from_world = pose.camera_from_world;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!pose.inlier[i]) continue;
    estimate.matches.push_back(matches[i]);
    estimate.map_matches += matches[i].landmark.valid();
  }
  return estimate;
}

/// By the hint, or constant velocity since the last frame, whatever the time between frames.
RigidTransform Tracker::PredictPose(const TrackingInput& input) const {
  if (input.motion_hint && input.motion_hint->last_stamp_ns == last_->stamp_ns) {
    return input.motion_hint->current_from_last * last_->camera_from_world;
  }
  if (!velocity_) return last_->camera_from_world;
  const double elapsed_s = NanosecondsToSeconds(input.stamp_ns - last_->stamp_ns);
  return ExpSe3(elapsed_s * *velocity_) * last_->camera_from_world;
}

std::optional<Tracker::Estimate> Tracker::TrackFromLastFrame(const TrackingInput& input) const {
  const RigidTransform predicted = PredictPose(input);
  const FrameView view{*input.features, predicted};
  double radius = options_.search_radius_px;
  auto matches = MatchLastFrame(model_, options_, *input.map, *last_, view, radius);
  if (static_cast<int>(matches.size()) < options_.min_motion_matches) {
    radius *= 2;
    matches = MatchLastFrame(model_, options_, *input.map, *last_, view, radius);
  }
  if (static_cast<int>(matches.size()) < options_.min_motion_matches) return {};
  auto estimate = OptimizeMatches(input, predicted, matches);
  if (!estimate || estimate->map_matches < options_.min_frame_inliers) return {};
  return estimate;
}

std::optional<Tracker::Estimate> Tracker::TrackFromKeyframe(const TrackingInput& input,
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
  Estimate estimate;
  estimate.camera_from_world = pose->camera_from_world;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (pose->inlier[i]) estimate.matches.push_back(matches[i]);
  }
  estimate.map_matches = static_cast<int>(estimate.matches.size());
  return estimate;
}

/// Tries the newest keyframes and those about the last known place.
std::optional<Tracker::Estimate> Tracker::Relocalize(const TrackingInput& input) const {
  constexpr std::size_t kCandidates = 20;
  std::vector<KeyframeId> candidates;
  if (input.map->keyframes.Find(reference_) != nullptr) {
    candidates.push_back(reference_);
    for (const CovisibleKeyframe& near : FindCovisible(*input.map, reference_)) {
      if (candidates.size() < kCandidates / 2) candidates.push_back(near.id);
    }
  }
  // Spread the rest over the whole map, another part in each frame.
  std::vector<KeyframeId> all;
  input.map->keyframes.ForEach([&](const Keyframe& keyframe) { all.push_back(keyframe.id); });
  const std::size_t step = std::max<std::size_t>(1, all.size() / (kCandidates / 2));
  for (std::size_t i = input.frame_id.value % step; i < all.size(); i += step) {
    candidates.push_back(all[i]);
  }
  for (const KeyframeId id : candidates) {
    auto estimate =
        TrackFromKeyframe(input, *input.map->keyframes.Find(id), options_.pnp.min_inliers);
    if (!estimate) continue;
    const TrackingResult trial = TrackLocalMap(input, *estimate);
    if (HasPose(trial.status) && trial.inliers >= options_.min_relocalization_inliers) {
      return estimate;
    }
  }
  return {};
}

TrackingResult Tracker::TrackLocalMap(const TrackingInput& input, const Estimate& estimate) const {
  TrackingResult result;
  result.status = TrackingStatus::kLost;
  result.landmarks.resize(input.features->size());
  const FrameView view{*input.features, estimate.camera_from_world};
  std::vector<PointMatch> matches;
  for (const PointMatch& match : estimate.matches) {
    if (match.landmark.valid()) matches.push_back(match);
  }
  const LocalMapMatches local = MatchLocalMap(model_, options_, *input.map, view, matches);
  std::vector<LandmarkId> looked_for = local.visible;
  for (const PointMatch& match : matches) looked_for.push_back(match.landmark);
  matches.insert(matches.end(), local.matches.begin(), local.matches.end());
  const auto refined = OptimizeMatches(input, estimate.camera_from_world, matches);
  const auto reference_pose = input.map->FindKeyframePose(local.reference);
  if (!refined || !reference_pose || refined->map_matches < options_.min_map_inliers) return result;

  result.status = TrackingStatus::kTracked;
  result.inliers = refined->map_matches;
  result.camera_from_world = refined->camera_from_world;
  result.reference = local.reference;
  result.camera_from_reference = result.camera_from_world * reference_pose->Inverse();
  std::map<LandmarkId, int> found;
  for (const PointMatch& match : refined->matches) {
    result.landmarks[match.feature] = match.landmark;
    found.emplace(match.landmark, match.feature);
  }
  for (const LandmarkId id : looked_for) {
    const auto feature = found.find(id);
    if (feature != found.end()) {
      const float probability = input.features->StaticProbability(feature->second);
      result.sightings.push_back({id, true, probability});
    } else {
      const bool moves = IsSeenMoving(input, result.camera_from_world, id);
      result.sightings.push_back({id, false, moves ? std::optional(0.0F) : std::nullopt});
    }
  }
  return result;
}

/// True where what moves in the image is as far away as the landmark: it is part of that, and not
/// hidden by it.
bool Tracker::IsSeenMoving(const TrackingInput& input, const RigidTransform& camera_from_world,
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

void Tracker::Remember(const TrackingInput& input, const TrackingResult& result) {
  if (!HasPose(result.status)) {
    last_.reset();
    velocity_.reset();
    return;
  }
  velocity_ = VelocityTo(input, result);
  last_ = TrackedFrame{input.frame_id, input.stamp_ns, input.features, result.landmarks,
                       result.camera_from_world};
  last_inliers_ = result.inliers;
  reference_ = result.reference;
  camera_from_reference_ = result.camera_from_reference;
  if (result.keyframe) last_keyframe_frame_ = input.frame_id;
}

}  // namespace ofm
