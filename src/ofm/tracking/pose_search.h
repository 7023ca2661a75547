// Ways to the camera's pose in a map: from the last frame, from a keyframe, and from there against
// all landmarks around.
#pragma once

#include <optional>
#include <vector>

#include "ofm/tracking/frame_matcher.h"
#include "ofm/tracking/tracking_types.h"

namespace ofm {

/// A pose with the matches that agree with it.
struct CameraEstimate {
  RigidTransform camera_from_world;
  std::vector<PointMatch> matches;  ///< inliers only
  int map_matches = 0;              ///< of these, how many show a landmark
  KeyframeId near = {};             ///< where to search with no matches at all
};

/// Finds poses of frames in snapshots of the map. Keeps nothing between calls.
class PoseSearch {
 public:
  /// `seed` decides all random draws, together with the frame's id.
  PoseSearch(const MeasurementModel& model, const TrackingOptions& options, std::uint64_t seed)
      : model_(model), options_(options), seed_(seed) {}

  /// Searches what `last` saw about where `predicted` puts it; empty with too few matches or
  /// inliers.
  std::optional<CameraEstimate> FromLastFrame(const TrackingInput& input, const TrackedFrame& last,
                                              const RigidTransform& predicted) const;
  /// By descriptors alone, without any idea of the motion; empty with fewer inliers.
  std::optional<CameraEstimate> FromKeyframe(const TrackingInput& input, const Keyframe& keyframe,
                                             int min_inliers) const;
  /// Guided search in the map about a first estimate: kTracked, or kLost with too few inliers.
  TrackingResult InLocalMap(const TrackingInput& input, const CameraEstimate& estimate) const;

  /// The landmarks that a frame's result names, as an estimate to search on from.
  static CameraEstimate EstimateOf(const TrackingInput& input, const TrackingResult& result);

  const TrackingOptions& options() const { return options_; }

 private:
  std::optional<CameraEstimate> Optimize(const TrackingInput& input, const RigidTransform& initial,
                                         const std::vector<PointMatch>& matches) const;
  CameraEstimate Align(TrackingInput& input, const CameraEstimate& estimate) const;
  std::vector<Sighting> MakeSightings(const TrackingInput& input, const CameraEstimate& refined,
                                      const std::vector<LandmarkId>& looked_for) const;
  bool IsSeenMoving(const TrackingInput& input, const RigidTransform& camera_from_world,
                    LandmarkId id) const;

  MeasurementModel model_;
  TrackingOptions options_;
  std::uint64_t seed_;
};

}  // namespace ofm
