#include "ofm/tracking/tracker.h"

#include <algorithm>

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
  TrackingResult result;
  result.landmarks.resize(input.features->size());
  SyncWithMap(*input.map);
  const bool was_lost = !last_.has_value();
  std::optional<Estimate> estimate = was_lost ? Relocalize(input) : TrackFromLastFrame(input);
  if (!estimate && !was_lost) estimate = Relocalize(input);
  result.status = was_lost ? TrackingStatus::kRelocalized : TrackingStatus::kTracked;
  if (!estimate || !TrackLocalMap(input, *estimate, result)) {
    result.status = TrackingStatus::kLost;
  } else if (NeedsKeyframe(GatherKeyframeEvidence(model_, input, result, last_keyframe_frame_),
                           options_.keyframe)) {
    result.keyframe = KeyframeCandidate{input.frame_id,
                                        input.stamp_ns,
                                        result.camera_from_world,
                                        result.reference,
                                        result.camera_from_reference,
                                        input.features,
                                        result.landmarks};
  }
  Remember(input, result);
  return result;
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
    observations.push_back({match.point_in_world, model_.Observe(*input.features, match.feature)});
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

std::optional<Tracker::Estimate> Tracker::TrackFromLastFrame(const TrackingInput& input) const {
  const RigidTransform predicted =
      motion_ ? *motion_ * last_->camera_from_world : last_->camera_from_world;
  const FrameView view{*input.features, predicted};
  double radius = options_.search_radius_px;
  auto matches = MatchLastFrame(model_, options_, *input.map, *last_, view, radius);
  if (static_cast<int>(matches.size()) < options_.min_motion_matches) {
    radius *= 2;
    matches = MatchLastFrame(model_, options_, *input.map, *last_, view, radius);
  }
  if (static_cast<int>(matches.size()) >= options_.min_motion_matches) {
    auto estimate = OptimizeMatches(input, predicted, matches);
    if (estimate && estimate->map_matches >= options_.min_frame_inliers) return estimate;
  }
  const Keyframe* reference = input.map->keyframes.Find(reference_);
  if (reference == nullptr) return {};
  return TrackFromKeyframe(input, *reference, options_.min_frame_inliers);
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
    TrackingResult trial;
    trial.landmarks.resize(input.features->size());
    Estimate refined = *estimate;
    if (TrackLocalMap(input, refined, trial) &&
        trial.inliers >= options_.min_relocalization_inliers) {
      return estimate;
    }
  }
  return {};
}

bool Tracker::TrackLocalMap(const TrackingInput& input, Estimate& estimate,
                            TrackingResult& result) const {
  const FrameView view{*input.features, estimate.camera_from_world};
  std::vector<PointMatch> known;
  for (const PointMatch& match : estimate.matches) {
    if (match.landmark.valid()) known.push_back(match);
  }
  LocalMapMatches local = MatchLocalMap(model_, options_, *input.map, view, known);
  std::vector<PointMatch> all = std::move(known);
  all.insert(all.end(), local.matches.begin(), local.matches.end());
  std::optional<Estimate> refined = OptimizeMatches(input, estimate.camera_from_world, all);
  if (!refined || refined->map_matches < options_.min_map_inliers) return false;
  for (const PointMatch& match : refined->matches) result.landmarks[match.feature] = match.landmark;
  std::vector<LandmarkId> found;
  for (const PointMatch& match : refined->matches) found.push_back(match.landmark);
  std::sort(found.begin(), found.end());
  std::vector<LandmarkId> looked_for = std::move(local.visible);
  for (const PointMatch& match : estimate.matches) {
    if (match.landmark.valid()) looked_for.push_back(match.landmark);
  }
  for (const LandmarkId id : looked_for) {
    result.sightings.push_back({id, std::binary_search(found.begin(), found.end(), id)});
  }
  result.inliers = refined->map_matches;
  result.camera_from_world = refined->camera_from_world;
  result.reference = local.reference;
  const auto reference_pose = input.map->FindKeyframePose(result.reference);
  if (!reference_pose) return false;
  result.camera_from_reference = result.camera_from_world * reference_pose->Inverse();
  estimate = std::move(*refined);
  return true;
}

void Tracker::Remember(const TrackingInput& input, const TrackingResult& result) {
  if (!HasPose(result.status)) {
    last_.reset();
    motion_.reset();
    return;
  }
  if (last_) {
    motion_ = result.camera_from_world * last_->camera_from_world.Inverse();
  } else {
    motion_.reset();
  }
  last_ = TrackedFrame{input.frame_id, input.features, result.landmarks, result.camera_from_world};
  reference_ = result.reference;
  camera_from_reference_ = result.camera_from_reference;
  if (result.keyframe) last_keyframe_frame_ = input.frame_id;
}

}  // namespace ofm
