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
      first_from_world_ = result.camera_from_world.Inverse() * frame.camera_from_world;
    }
    if (result.keyframe) Add(*result.keyframe);
    return result;
  }
  TrackingResult Step(std::uint32_t frame_id) { return Step(world_.Frame(frame_id)); }

  /// camera_from_world in the map's world, of which the newest sub-map's first camera tells.
  RigidTransform Truth(const MadeFrame& frame) const {
    return frame.camera_from_world * first_from_world_.Inverse();
  }
  const FeatureWorld& world() const { return world_; }
  Map& map() { return map_; }

 private:
  void Add(const KeyframeCandidate& candidate) {
    Keyframe keyframe = MakeTestKeyframe(candidate.features, candidate.camera_from_world);
    keyframe.frame_id = candidate.frame_id;
    keyframe.stamp_ns = candidate.stamp_ns;
    keyframe.landmarks = candidate.landmarks;
    keyframe.submap = candidate.begins_submap ? SubmapId() : map_.FindSubmap(candidate.reference);
    AddWithDepth(map_, world_.model(), std::move(keyframe));
  }

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
