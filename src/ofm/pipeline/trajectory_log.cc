#include "ofm/pipeline/trajectory_log.h"

#include <algorithm>

namespace ofm {

void TrajectoryLog::Add(FrameId frame, std::int64_t stamp_ns, const TrackingResult& result,
                        SubmapId submap) {
  OFM_CHECK(entries_.empty() || entries_.back().frame < frame);
  entries_.push_back({frame, stamp_ns, result.status, result.camera_from_world.Inverse(),
                      result.reference, result.camera_from_reference, submap});
}

void TrajectoryLog::SetKeyframe(FrameId frame, KeyframeId keyframe) {
  const auto before = [](const Entry& entry, FrameId id) { return entry.frame < id; };
  const auto entry = std::lower_bound(entries_.begin(), entries_.end(), frame, before);
  OFM_CHECK(entry != entries_.end() && entry->frame == frame);
  entry->reference = keyframe;
  entry->camera_from_reference = RigidTransform();
  if (entry->status == TrackingStatus::kInitialized) entry->submap = SubmapId(keyframe.value);
}

Trajectory TrajectoryLog::Live(SubmapId submap) const {
  Trajectory trajectory;
  for (const Entry& entry : entries_) {
    if (!HasPose(entry.status) || entry.submap != submap) continue;
    trajectory.push_back({entry.stamp_ns, entry.world_from_camera});
  }
  return trajectory;
}

Trajectory TrajectoryLog::Optimized(const MapSnapshot& map, SubmapId submap) const {
  Trajectory trajectory;
  for (const Entry& entry : entries_) {
    if (!HasPose(entry.status)) continue;
    const auto reference = map.FindKeyframePose(entry.reference);
    if ((reference ? map.FindSubmap(entry.reference) : entry.submap) != submap) continue;
    const RigidTransform world_from_camera =
        reference ? (entry.camera_from_reference * *reference).Inverse() : entry.world_from_camera;
    trajectory.push_back({entry.stamp_ns, world_from_camera});
  }
  return trajectory;
}

std::size_t TrajectoryLog::CountWithPose() const {
  return std::count_if(entries_.begin(), entries_.end(),
                       [](const Entry& entry) { return HasPose(entry.status); });
}

std::size_t TrajectoryLog::CountReckoned() const {
  return std::ranges::count(entries_, TrackingStatus::kReckoned, &Entry::status);
}

Trajectory KeyframeTrajectory(const MapSnapshot& map, SubmapId submap) {
  Trajectory trajectory;
  map.keyframes.ForEach([&](const Keyframe& keyframe) {
    if (keyframe.submap != submap) return;
    trajectory.push_back({keyframe.stamp_ns, keyframe.camera_from_world.Inverse()});
  });
  std::ranges::stable_sort(trajectory, {}, &StampedPose::stamp_ns);
  const auto repeated = std::ranges::unique(trajectory, {}, &StampedPose::stamp_ns);
  trajectory.erase(repeated.begin(), repeated.end());
  return trajectory;
}

}  // namespace ofm
