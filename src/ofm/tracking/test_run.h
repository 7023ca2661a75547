// A tracker at work on the made world. Tests only.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "ofm/tracking/test_world.h"
#include "ofm/tracking/tracker.h"

namespace ofm::test {

/// A tracker, and a map that takes every keyframe that it proposes at once.
class TrackingRun {
 public:
  explicit TrackingRun(const FeatureWorldOptions& world = DefaultWorld(),
                       const TrackingOptions& options = {})
      : world_(world), tracker_(world_.model(), options, 1) {}

  /// `change` edits what the tracker is told of the frame.
  TrackingResult Step(const MadeFrame& frame,
                      const std::function<void(TrackingInput&)>& change = {}) {
    TrackingInput input = MakeInput(frame, map_.Snapshot());
    if (change) change(input);
    TrackingResult result = tracker_.Process(input);
    if (result.status == TrackingStatus::kInitialized) {
      first_from_world_ = frame.camera_from_world;
    }
    if (result.keyframe) {
      AddWithDepth(map_, world_.model(), frame, result.keyframe->camera_from_world,
                   result.keyframe->landmarks);
    }
    return result;
  }
  TrackingResult Step(std::uint32_t frame_id) { return Step(world_.Frame(frame_id)); }

  /// camera_from_world in the map's world, that of the first camera.
  RigidTransform Truth(const MadeFrame& frame) const {
    return frame.camera_from_world * first_from_world_.Inverse();
  }
  const FeatureWorld& world() const { return world_; }
  Map& map() { return map_; }

 private:
  FeatureWorld world_;
  Map map_{TestScales()};
  Tracker tracker_;
  RigidTransform first_from_world_;
};

inline void ExpectPose(const RigidTransform& pose, const RigidTransform& truth, double metres,
                       double degrees) {
  EXPECT_LE(DistanceOfCentres_m(pose, truth), metres);
  EXPECT_LE(AngleBetween_deg(pose, truth), degrees);
}

}  // namespace ofm::test
