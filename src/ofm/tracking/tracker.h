// The tracking stage: the camera's pose for every frame.
#pragma once

#include <optional>

#include "ofm/base/random.h"
#include "ofm/tracking/frame_matcher.h"
#include "ofm/tracking/tracking_types.h"

namespace ofm {

/// Follows the camera against snapshots of the map: prediction by constant velocity, frame to
/// frame, then the local map (the scheme published for ORB-SLAM2, Mur-Artal and Tardos 2017,
/// section III). Serves one thread.
class Tracker {
 public:
  /// `seed` decides all random draws, together with the frame's id.
  Tracker(const MeasurementModel& model, const TrackingOptions& options, std::uint64_t seed);

  /// Tracks one frame. Frames come in increasing order of id and time.
  TrackingResult Process(const TrackingInput& input);

 private:
  struct Estimate;

  TrackingResult Initialize(const TrackingInput& input) const;
  TrackingResult TrackOrRelocalize(const TrackingInput& input) const;
  TrackingInput AlignDepth(const TrackingInput& input,
                           const std::optional<Vector6d>& velocity) const;
  std::optional<Vector6d> VelocityTo(const TrackingInput& input,
                                     const TrackingResult& result) const;
  RigidTransform PredictPose(const TrackingInput& input) const;
  void SyncWithMap(const MapSnapshot& map);
  std::optional<Estimate> TrackFromLastFrame(const TrackingInput& input) const;
  std::optional<Estimate> TrackFromKeyframe(const TrackingInput& input, const Keyframe& keyframe,
                                            int min_inliers) const;
  std::optional<Estimate> Relocalize(const TrackingInput& input) const;
  bool IsSeenMoving(const TrackingInput& input, const RigidTransform& camera_from_world,
                    LandmarkId id) const;
  TrackingResult TrackLocalMap(const TrackingInput& input, const Estimate& estimate) const;
  std::optional<Estimate> OptimizeMatches(const TrackingInput& input, const RigidTransform& initial,
                                          const std::vector<PointMatch>& matches) const;
  void Remember(const TrackingInput& input, const TrackingResult& result);

  MeasurementModel model_;
  TrackingOptions options_;
  std::uint64_t seed_;
  std::optional<TrackedFrame> last_;      // with a pose; empty while lost or waiting
  KeyframeId reference_;                  // of the last frame with a pose
  RigidTransform camera_from_reference_;  // of the last frame with a pose
  std::optional<Vector6d> velocity_;      // twist of camera_from_world per second
  int last_inliers_ = 0;
  FrameId last_keyframe_frame_;  // the newest frame that was proposed as keyframe
};

}  // namespace ofm
