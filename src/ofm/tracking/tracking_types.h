// What goes into the tracking stage and what comes out.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "ofm/base/ids.h"
#include "ofm/features/frame_features.h"
#include "ofm/map/map.h"

namespace ofm {

enum class TrackingStatus {
  kWaiting,      ///< no map yet, and the frame has too few features with depth to begin one
  kInitialized,  ///< this frame begins the map, or a sub-map
  kTracked,      ///< the pose is known
  kRelocalized,  ///< the pose is known again, after a loss
  kReckoned,     ///< no landmark was found; the pose follows from the camera's motion alone
  kLost,         ///< the pose is not known
};

/// True where the frame has a pose.
inline bool HasPose(TrackingStatus status) {
  return status == TrackingStatus::kInitialized || status == TrackingStatus::kTracked ||
         status == TrackingStatus::kRelocalized || status == TrackingStatus::kReckoned;
}

struct TrackingInput {
  FrameId frame_id;
  std::int64_t stamp_ns = 0;
  std::shared_ptr<const FrameFeatures> features;
  cv::Mat depth_m;  ///< CV_32FC1 [m]; empty where its time is that of the colour image
  std::int64_t depth_stamp_ns = 0;  ///< of depth_m
  std::shared_ptr<const MapSnapshot> map;
  int keyframes_waiting = 0;  ///< for mapping; 0 where it is idle
  /// How the camera moved since `last_stamp_ns`, where something else has told it; better than
  /// constant velocity.
  struct MotionHint {
    std::int64_t last_stamp_ns = 0;
    RigidTransform current_from_last;
  };
  std::optional<MotionHint> motion_hint;
  /// CV_8UC1, 255 where something moves: landmarks found there move. Empty = nothing is told.
  cv::Mat moving_mask;
};

/// A frame that should become a keyframe.
struct KeyframeCandidate {
  FrameId frame_id;
  std::int64_t stamp_ns = 0;
  RigidTransform camera_from_world;
  KeyframeId reference;  ///< against which the pose is known; invalid where there is none
  RigidTransform camera_from_reference;
  bool begins_submap = false;  ///< its place in the map is not known: the pose is a guess
  std::shared_ptr<const FrameFeatures> features;
  std::vector<LandmarkId> landmarks;  ///< by feature
};

/// That a landmark was looked for, and what came of it.
struct Sighting {
  LandmarkId landmark;
  bool found = false;
  /// What the frame says of the landmark, 0 to 1; empty where it says nothing.
  std::optional<float> static_probability = {};
};

struct TrackingResult {
  TrackingStatus status = TrackingStatus::kWaiting;
  RigidTransform camera_from_world;  ///< valid where HasPose(status)
  KeyframeId reference;              ///< keyframe that shares most landmarks; invalid at first
  RigidTransform camera_from_reference;
  /// The camera when the depth image was taken, from the camera when the colour image was; identity
  /// where its motion is not known.
  RigidTransform depth_from_color;
  /// Those of the input, at the places that alignment with the map found; null where the pose is
  /// not by the map.
  std::shared_ptr<const FrameFeatures> features;
  std::vector<LandmarkId> landmarks;  ///< by feature: inliers of the pose
  std::vector<Sighting> sightings;
  int inliers = 0;
  std::optional<KeyframeCandidate> keyframe;
};

}  // namespace ofm
