// The tracking stage: the camera's pose for every frame.
#pragma once

#include <optional>

#include "ofm/tracking/pose_search.h"
#include "ofm/tracking/tracking_types.h"

namespace ofm {

/// Follows the camera against snapshots of the map: prediction by constant velocity, frame to
/// frame, then the local map (the scheme published for ORB-SLAM2, Mur-Artal and Tardos 2017,
/// section III). Where it stays lost it begins a new sub-map (as published for ORB-SLAM3, Campos et
/// al. 2021, section VI). Serves one thread.
class Tracker {
 public:
  /// `seed` decides all random draws, together with the frame's id.
  Tracker(const MeasurementModel& model, const TrackingOptions& options, std::uint64_t seed);

  /// Tracks one frame. Frames come in increasing order of id and time.
  TrackingResult Process(const TrackingInput& input);

 private:
  TrackingResult Initialize(const TrackingInput& input,
                            const RigidTransform& camera_from_world) const;
  TrackingResult TrackOrRelocalize(const TrackingInput& input) const;
  bool IsLostForGood(const TrackingInput& input);
  std::optional<TrackingResult> Reckon(const TrackingInput& input) const;
  bool ContinuesMap(const TrackingInput& input, const TrackingResult& result) const;
  TrackingInput AlignDepth(const TrackingInput& input,
                           const std::optional<Vector6d>& velocity) const;
  std::optional<Vector6d> VelocityTo(const TrackingInput& input,
                                     const TrackingResult& result) const;
  RigidTransform PredictPose(const TrackingInput& input) const;
  void SyncWithMap(const MapSnapshot& map);
  void Remember(const TrackingInput& input, const TrackingResult& result);

  MeasurementModel model_;
  TrackingOptions options_;
  PoseSearch search_;
  std::optional<TrackedFrame> last_;      // with a pose; empty while lost or waiting
  KeyframeId reference_;                  // of the last frame with a pose
  RigidTransform camera_from_reference_;  // of the last frame with a pose
  std::optional<Vector6d> velocity_;      // twist of camera_from_world per second
  int last_inliers_ = 0;
  std::int64_t fix_stamp_ns_ = 0;              // of the last frame that was not reckoned
  std::optional<std::int64_t> lost_stamp_ns_;  // of the first lost frame that shows enough
  FrameId last_keyframe_frame_;                // the newest frame that was proposed as keyframe
};

}  // namespace ofm
