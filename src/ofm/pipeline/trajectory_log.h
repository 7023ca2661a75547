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
  void Add(FrameId frame, std::int64_t stamp_ns, const TrackingResult& result);
  /// Tells that a logged frame became a keyframe: from then on it is the keyframe's pose.
  void SetKeyframe(FrameId frame, KeyframeId keyframe);

  /// As known at the time of each frame.
  Trajectory Live() const;
  /// As the map knows it now.
  Trajectory Optimized(const MapSnapshot& map) const;

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
  };

  std::vector<Entry> entries_;  // by increasing frame id
};

/// Poses of the keyframes that are in the map, by time; of two of the same time, as where a
/// recording was mapped twice, the older one.
Trajectory KeyframeTrajectory(const MapSnapshot& map);

}  // namespace ofm
