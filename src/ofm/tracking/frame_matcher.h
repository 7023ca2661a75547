// Finds the features of a new frame that show known points.
#pragma once

#include <span>
#include <vector>

#include "ofm/map/map.h"
#include "ofm/tracking/measurement.h"
#include "ofm/tracking/options.h"

namespace ofm {

/// A feature and the point of the world that it shows.
struct PointMatch {
  int feature = 0;
  LandmarkId landmark;  ///< invalid for a point that only the last frame's depth tells
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
};

/// The previous frame, for prediction.
struct TrackedFrame {
  FrameId id;
  std::int64_t stamp_ns = 0;
  std::shared_ptr<const FrameFeatures> features;
  std::vector<LandmarkId> landmarks;  ///< by feature
  RigidTransform camera_from_world;
};

/// Where the search takes place.
struct FrameView {
  const FrameFeatures& features;
  RigidTransform camera_from_world;  ///< predicted or first estimate
  KeyframeId near = {};  ///< whose surroundings are searched where no landmark is known yet
};

/// The points that `last` saw, projected with the predicted pose and searched within `radius_px` at
/// octave 0. Features of `last` with close depth but no landmark serve too.
std::vector<PointMatch> MatchLastFrame(const MeasurementModel& model,
                                       const TrackingOptions& options, const MapSnapshot& map,
                                       const TrackedFrame& last, const FrameView& view,
                                       double radius_px);

/// Landmarks of the map around the frame, matched by projection.
struct LocalMapMatches {
  std::vector<PointMatch> matches;  ///< in addition to those handed in
  std::vector<LandmarkId> visible;  ///< that should be in view, handed-in ones left out
  KeyframeId reference;             ///< sees most of the frame's landmarks
};

/// Searches landmarks of the keyframes that see what `known` names (of `view.near` where that is
/// nothing), and of their neighbours.
LocalMapMatches MatchLocalMap(const MeasurementModel& model, const TrackingOptions& options,
                              const MapSnapshot& map, const FrameView& view,
                              std::span<const PointMatch> known);

/// All features against all of a keyframe's landmarks by descriptor alone; many matches may be
/// wrong.
std::vector<PointMatch> MatchKeyframe(const TrackingOptions& options, const MapSnapshot& map,
                                      const Keyframe& keyframe, const FrameFeatures& frame);

}  // namespace ofm
