// The pose of every frame, told relative to keyframes so that it follows when these are adjusted.
#pragma once

#include <vector>

#include "ofm/geometry/trajectory.h"
#include "ofm/map/map.h"
#include "ofm/tracking/tracking_types.h"

namespace ofm {

/// Collects tracking results; gives trajectories of the frames that have a pose.
class TrajectoryLog {
 public:
  /// `submap` is that of the pose, as known now.
  void Add(FrameId frame, std::int64_t stamp_ns, const TrackingResult& result,
           SubmapId submap = SubmapId(0));
  /// Tells that a logged frame became a keyframe: from then on it is the keyframe's pose. One that
  /// began a sub-map was in that.
  void SetKeyframe(FrameId frame, KeyframeId keyframe);

  /// As known at the time of each frame. Frames whose place in the world of `submap` was not known
  /// at their time are left out, even where it was found later.
  Trajectory Live(SubmapId submap) const;
  /// The frames of `submap` as the map knows them now.
  Trajectory Optimized(const MapSnapshot& map, SubmapId submap) const;

  std::size_t frames() const { return entries_.size(); }
  std::size_t CountWithPose() const;
  std::size_t CountReckoned() const;

 private:
  struct Entry {
    FrameId frame;
    std::int64_t stamp_ns;
    TrackingStatus status;
    RigidTransform world_from_camera;  // live
    KeyframeId reference;
    RigidTransform camera_from_reference;
    SubmapId submap;  // live
  };

  std::vector<Entry> entries_;  // by increasing frame id
};

/// Poses of the keyframes that are in the sub-map, by time; of two of the same time, as where a
/// recording was mapped twice, the older one.
Trajectory KeyframeTrajectory(const MapSnapshot& map, SubmapId submap);

}  // namespace ofm
