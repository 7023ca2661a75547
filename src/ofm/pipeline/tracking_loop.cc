#include "ofm/pipeline/tracking_loop.h"

#include <algorithm>

#include "ofm/map/submap.h"

namespace ofm {
namespace {

/// The sub-map of a pose; one that begins there has no number yet, but for the first.
SubmapId SubmapOf(const TrackingResult& result, const MapSnapshot* map) {
  if (map == nullptr || map->keyframe_count == 0) return SubmapId(0);
  return map->FindSubmap(result.reference);
}

FrameRecord MakeRecord(const PreparedFrame& prepared, const TrackingResult& result) {
  FrameRecord record;
  record.stamp_ns = prepared.frame.stamp_ns;
  record.status = result.status;
  record.is_keyframe = result.keyframe.has_value();
  record.masked_share = prepared.dynamic.masked_share;
  record.instances = prepared.segmentation.instances.size();
  record.features = prepared.features->keypoints.size();
  record.inliers = static_cast<std::size_t>(std::max(result.inliers, 0));
  return record;
}

}  // namespace

std::optional<KeyframeJob> TrackingLoop::Process(const PreparedFrame& prepared,
                                                 std::shared_ptr<const MapSnapshot> map,
                                                 int keyframes_waiting) {
  TrackingInput input;
  input.frame_id = prepared.frame.id;
  input.stamp_ns = prepared.frame.stamp_ns;
  input.features = prepared.features;
  input.depth_m = prepared.frame.depth_m;
  input.depth_stamp_ns = prepared.frame.depth_stamp_ns;
  input.map = std::move(map);
  if (const auto& motion = prepared.dynamic.camera_motion) {
    input.motion_hint = {motion->last_stamp_ns, motion->current_from_last};
  }
  if (!prepared.dynamic.static_probability.empty()) input.moving_mask = prepared.dynamic.mask;
  input.keyframes_waiting = keyframes_waiting;
  TrackingResult result;
  {
    ScopedStageTimer timer(times_, "tracking");
    result = slam_.tracker().Process(input);
  }
  const SubmapId submap = SubmapOf(result, input.map.get());
  log_.Add(input.frame_id, input.stamp_ns, result, submap);
  const bool begins = result.status == TrackingStatus::kInitialized;
  if (begins && !submap.valid()) ++submaps_begun_;
  const bool lost = result.status == TrackingStatus::kLost;
  if (lost && !lost_) ++losses_;
  lost_ = lost;
  frames_.push_back(MakeRecord(prepared, result));
  masked_sum_ += prepared.dynamic.masked_share;
  if (slam_.makes_objects()) {
    ScopedStageTimer timer(times_, "object_tracks");
    object_tracks_.Add(input.stamp_ns, prepared.frame.depth_m, prepared.dynamic.followed);
  }
  const bool mapping = !slam_.options().localize_only;
  if (mapping) {
    sightings_.insert(sightings_.end(), result.sightings.begin(), result.sightings.end());
  }
  FrameReport report{prepared, result, log_.frames()};
  if (input.map) {
    report.keyframes = input.map->keyframe_count;
    report.landmarks = input.map->landmark_count;
    report.map = input.map;
  }
  for (RunObserver* observer : context_.observers) observer->OnFrame(report);
  const bool for_map = mapping && slam_.options().build_semantic_map;
  if (!result.keyframe || !mapping) {
    if (for_map) views_.Add(prepared, result);
    return {};
  }
  ++keyframes_made_;
  KeyframeJob job;
  job.candidate = std::move(*result.keyframe);
  job.sightings = std::move(sightings_);
  sightings_.clear();
  if (for_map) {
    if (input.map) job.dense.views = views_.Take(job.candidate, *input.map);
    job.dense.labelled = MakeLabelledFrame(prepared, result.depth_from_color);
  }
  if (slam_.makes_objects()) job.dense.instances = MakeInstanceFrame(prepared);
  return job;
}

void TrackingLoop::Finish(const BackEnd& back_end, RunOutcome& outcome) {
  for (const auto& [frame, keyframe] : back_end.keyframe_of_frame()) {
    log_.SetKeyframe(frame, keyframe);
  }
  outcome.trajectory = log_.Optimized(*outcome.map, outcome.submap);
  outcome.live_trajectory = log_.Live(outcome.submap);
  if (outcome.objects) outcome.objects->tracks = object_tracks_.Build(outcome.trajectory);
  outcome.keyframe_trajectory = KeyframeTrajectory(*outcome.map, outcome.submap);
  for (const SubmapSize& submap : FindSubmaps(*outcome.map)) {
    if (submap.id == outcome.submap) continue;
    outcome.unjoined.push_back(
        {submap.id, submap.keyframes, log_.Optimized(*outcome.map, submap.id)});
  }
  outcome.class_names = slam_.front_end().class_names();
  outcome.frames = std::move(frames_);
  outcome.times.Merge(times_);
  outcome.times.Merge(back_end.times());
  outcome.counts.frames = log_.frames();
  outcome.counts.frames_tracked = log_.CountWithPose();
  outcome.counts.frames_reckoned = log_.CountReckoned();
  outcome.counts.keyframes_made = keyframes_made_;
  outcome.counts.keyframes = outcome.map->keyframe_count;
  outcome.counts.landmarks = outcome.map->landmark_count;
  outcome.counts.losses = losses_;
  outcome.counts.submaps_begun = submaps_begun_;
  if (log_.frames() > 0) outcome.counts.mean_masked_share = masked_sum_ / log_.frames();
}

}  // namespace ofm
