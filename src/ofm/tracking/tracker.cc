#include "ofm/tracking/tracker.h"

#include <algorithm>

#include "ofm/base/time.h"
#include "ofm/tracking/keyframe_decision.h"
#include "ofm/tracking/relocalizer.h"

namespace ofm {

Tracker::Tracker(const MeasurementModel& model, const TrackingOptions& options, std::uint64_t seed)
    : model_(model), options_(options), search_(model, options, seed) {}

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
  const auto consider = [&](const std::optional<CameraEstimate>& estimate) {
    if (!estimate) return;
    TrackingResult result = search_.InLocalMap(input, *estimate);
    if (HasPose(result.status) && result.inliers > best.inliers) best = std::move(result);
  };
  if (last_) {
    consider(search_.FromLastFrame(input, *last_, PredictPose(input)));
    if (!HasPose(best.status)) consider(CameraEstimate{PredictPose(input), {}, 0, reference_});
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
  const auto has_depth = [](float depth) { return depth > 0; };
  return std::ranges::count_if(input.features->depth_m, has_depth) >= options.min_features &&
         input.keyframes_waiting == 0;
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
  velocity_ = VelocityTo(input, result);
  last_ = TrackedFrame{input.frame_id, input.stamp_ns, input.features, result.landmarks,
                       result.camera_from_world};
  last_inliers_ = result.inliers;
  if (result.status != TrackingStatus::kReckoned || result.keyframe) fix_stamp_ns_ = input.stamp_ns;
  reference_ = result.reference;
  camera_from_reference_ = result.camera_from_reference;
  if (result.keyframe) last_keyframe_frame_ = input.frame_id;
}

}  // namespace ofm
