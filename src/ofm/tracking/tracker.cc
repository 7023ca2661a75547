#include "ofm/tracking/tracker.h"

#include <algorithm>

#include "ofm/base/time.h"
#include "ofm/tracking/keyframe_decision.h"
#include "ofm/tracking/relocalizer.h"

namespace ofm {
namespace {

int CountWithDepth(const FrameFeatures& features) {
  return static_cast<int>(
      std::ranges::count_if(features.depth_m, [](float depth) { return depth > 0; }));
}

/// Of the depth image behind the colour image; 0 where both are of one time.
double DepthDelay_s(const TrackingInput& input) {
  if (input.depth_m.empty()) return 0;
  return NanosecondsToSeconds(input.depth_stamp_ns - input.stamp_ns);
}

}  // namespace

Tracker::Tracker(const MeasurementModel& model, const TrackingOptions& options, std::uint64_t seed)
    : model_(model), options_(options), search_(model, options, seed) {}

TrackingResult Tracker::Process(const TrackingInput& input) {
  if (input.map == nullptr || input.map->keyframe_count == 0) {
    TrackingResult result = Initialize(input, {});
    Remember(input, result);
    return result;
  }
  SyncWithMap(*input.map);
  TrackingResult result = TrackOrRelocalize(AlignDepth(input, velocity_));
  if (!HasPose(result.status) && IsLostForGood(input)) {
    // Where it lies is not known; about the last known place is as good as anywhere.
    const auto last_known = input.map->FindKeyframePose(reference_);
    result =
        Initialize(input, last_known ? camera_from_reference_ * *last_known : RigidTransform());
    Remember(input, result);
    return result;
  }
  // Once more with the motion that was found: the predicted one is not good enough for landmarks.
  const std::optional<Vector6d> velocity = VelocityTo(input, result);
  TrackingInput placed = input;
  if (result.features) placed.features = result.features;
  const TrackingInput aligned = AlignDepth(placed, velocity);
  if (velocity) result.depth_from_color = ExpSe3(DepthDelay_s(input) * *velocity);
  const bool is_needed =
      HasPose(result.status) && result.inliers > 0 &&
      NeedsKeyframe(GatherKeyframeEvidence(model_, aligned, result, last_keyframe_frame_),
                    options_.keyframe);
  if (is_needed || ContinuesMap(aligned, result)) {
    result.keyframe = KeyframeCandidate{input.frame_id,
                                        input.stamp_ns,
                                        result.camera_from_world,
                                        result.reference,
                                        result.camera_from_reference,
                                        false,
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
  const double delay_s = DepthDelay_s(input);
  if (velocity && delay_s != 0) {
    aligned.features = AlignDepthInTime(*input.features, input.depth_m, ExpSe3(delay_s * *velocity),
                                        model_.camera);
  }
  return aligned;
}

/// Twist per second from the last frame to this one; empty where either has no pose, or their poses
/// are in different worlds.
std::optional<Vector6d> Tracker::VelocityTo(const TrackingInput& input,
                                            const TrackingResult& result) const {
  if (!HasPose(result.status) || !last_ || input.stamp_ns <= last_->stamp_ns) return {};
  if (result.status == TrackingStatus::kInitialized) return {};
  if (input.map->FindSubmap(result.reference) != input.map->FindSubmap(reference_)) return {};
  const double elapsed_s = NanosecondsToSeconds(input.stamp_ns - last_->stamp_ns);
  return LogSe3(result.camera_from_world * last_->camera_from_world.Inverse()) / elapsed_s;
}

/// Follows the last frame; where that fails or leaves few inliers, the reference keyframe is asked
/// too, by descriptors alone, and the better of the two answers counts.
TrackingResult Tracker::TrackOrRelocalize(const TrackingInput& input) const {
  TrackingResult best;
  best.status = TrackingStatus::kLost;
  best.landmarks.resize(input.features->size());
  const auto consider = [&](const std::optional<CameraEstimate>& estimate) {
    if (!estimate) return;
    TrackingResult result = search_.InLocalMap(input, *estimate);
    if (HasPose(result.status) && result.inliers > best.inliers) best = std::move(result);
  };
  if (last_) {
    consider(search_.FromLastFrame(input, *last_, PredictPose(input)));
    // Where the last frame has no landmarks, by the place alone; the newest keyframe may not share
    // any with the reference. Of another sub-map it says nothing of the place.
    const SubmapId submap = input.map->FindSubmap(reference_);
    for (const KeyframeId near : {reference_, input.map->latest_keyframe}) {
      if (HasPose(best.status) || input.map->FindSubmap(near) != submap) continue;
      consider(CameraEstimate{PredictPose(input), {}, 0, near});
    }
    const Keyframe* reference = input.map->keyframes.Find(reference_);
    if (reference != nullptr && best.inliers < options_.doubtful_share * last_inliers_) {
      consider(search_.FromKeyframe(input, *reference, options_.min_frame_inliers));
    }
  }
  if (HasPose(best.status)) return best;
  if (auto found = Relocalize(search_, input, reference_)) return *std::move(found);
  if (auto reckoned = Reckon(input)) return *std::move(reckoned);
  return best;
}

/// The last pose and the camera's motion since; empty where that is not known or no longer good
/// enough. Constant velocity is believed for one frame only.
std::optional<TrackingResult> Tracker::Reckon(const TrackingInput& input) const {
  if (!last_ || input.stamp_ns - fix_stamp_ns_ > options_.dead_reckoning.max_s * 1e9) return {};
  const bool is_measured = input.motion_hint && input.motion_hint->last_stamp_ns == last_->stamp_ns;
  const bool is_first = last_->stamp_ns == fix_stamp_ns_;
  if (!is_measured && !(is_first && velocity_)) return {};
  TrackingResult result;
  result.status = TrackingStatus::kReckoned;
  result.camera_from_world = PredictPose(input);
  result.reference = reference_;
  result.camera_from_reference =
      result.camera_from_world * last_->camera_from_world.Inverse() * camera_from_reference_;
  result.landmarks.resize(input.features->size());
  return result;
}

/// Whether a frame without landmarks should become a keyframe: the camera looks sharply at what
/// the map does not have.
bool Tracker::ContinuesMap(const TrackingInput& input, const TrackingResult& result) const {
  const DeadReckoningOptions& options = options_.dead_reckoning;
  if (result.status != TrackingStatus::kReckoned || !input.motion_hint) return false;
  if (input.stamp_ns - fix_stamp_ns_ < options.keyframe_s * 1e9) return false;
  return CountWithDepth(*input.features) >= options.min_features && input.keyframes_waiting == 0;
}

/// Whether the frame, which has no pose, should begin a sub-map: it shows enough for that, and so
/// did one a while before it that was not recognised either.
bool Tracker::IsLostForGood(const TrackingInput& input) {
  if (!options_.submap.enabled) return false;
  if (CountWithDepth(*input.features) < options_.min_start_features) return false;
  if (!lost_stamp_ns_) lost_stamp_ns_ = input.stamp_ns;
  return input.stamp_ns - *lost_stamp_ns_ >= options_.submap.begin_after_s * 1e9 &&
         input.keyframes_waiting == 0;
}

/// The frame as the first one of a map or sub-map.
TrackingResult Tracker::Initialize(const TrackingInput& input,
                                   const RigidTransform& camera_from_world) const {
  TrackingResult result;
  result.landmarks.resize(input.features->size());
  if (CountWithDepth(*input.features) < options_.min_start_features) return result;
  result.status = TrackingStatus::kInitialized;
  result.camera_from_world = camera_from_world;
  KeyframeCandidate candidate;
  candidate.begins_submap = true;
  candidate.camera_from_world = camera_from_world;
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
    fix_stamp_ns_ = last_->stamp_ns;
  }
  const auto reference_pose = map.FindKeyframePose(reference_);
  if (reference_pose) last_->camera_from_world = camera_from_reference_ * *reference_pose;
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

void Tracker::Remember(const TrackingInput& input, const TrackingResult& result) {
  if (!HasPose(result.status)) {
    last_.reset();
    velocity_.reset();
    return;
  }
  lost_stamp_ns_.reset();
  velocity_ = VelocityTo(input, result);
  last_ = TrackedFrame{input.frame_id, input.stamp_ns, input.features, result.landmarks,
                       result.camera_from_world};
  last_inliers_ = result.inliers;
  if (result.status != TrackingStatus::kReckoned) fix_stamp_ns_ = input.stamp_ns;
  reference_ = result.reference;
  camera_from_reference_ = result.camera_from_reference;
  if (result.keyframe) last_keyframe_frame_ = input.frame_id;
}

}  // namespace ofm
