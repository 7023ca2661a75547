// What an optimiser found out about a snapshot, to be applied to the map as it has become since.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "ofm/map/map.h"

namespace ofm {

/// That a feature of a keyframe shows a landmark.
struct LandmarkSighting {
  LandmarkId landmark;
  KeyframeId keyframe;
  int feature = 0;
};

/// That a sub-map becomes part of another one.
struct SubmapJoin {
  SubmapId from, into;
};

/// New places of all keyframes of a snapshot, and what else is to be changed. A value.
struct MapCorrection {
  struct KeyframeMove {
    RigidTransform before, after;  ///< camera_from_world
  };
  struct LandmarkMove {
    Eigen::Vector3d before, after;  ///< in the world [m]
  };

  /// All of the snapshot: a keyframe that is not named was added later.
  std::map<KeyframeId, KeyframeMove> keyframes;
  /// Landmarks that are not named move with their keyframe.
  std::map<LandmarkId, LandmarkMove> landmarks;
  /// Observations that are found wrong.
  std::vector<LandmarkSighting> wrong;
  /// Features that show known landmarks. Where a feature shows another one, that one is fused into
  /// the known one; two landmarks that are both named here are never fused.
  std::vector<LandmarkSighting> found;
  /// Where the moves bring a sub-map into the world of another one.
  std::optional<SubmapJoin> join;
};

struct CorrectionReport {
  int observations_removed = 0, observations_added = 0;
  int landmarks_fused = 0;
};

/// Applies the correction to what is still there. Who was moved since the snapshot was taken keeps
/// that motion, and what was added since moves along with the keyframe it shares most landmarks
/// with, or one of its sub-map: nobody has to wait for an optimiser (as in Cartographer, Hess et
/// al., Real-Time Loop Closure in 2D LIDAR SLAM, ICRA 2016).
CorrectionReport ApplyCorrection(const MapCorrection& correction, Map& map);

}  // namespace ofm
