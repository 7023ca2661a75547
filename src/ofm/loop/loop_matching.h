// Finds landmarks of an earlier place in a keyframe.
#pragma once

#include <vector>

#include "ofm/map/map.h"
#include "ofm/tracking/measurement.h"

namespace ofm {

/// A keyframe's feature and the landmark of another place that it shows.
struct LoopMatch {
  int feature = 0;
  LandmarkId landmark;
};

/// The keyframes about a place, itself first, then its best neighbours.
std::vector<KeyframeId> KeyframesAbout(const MapSnapshot& map, KeyframeId id);

/// Landmarks that these keyframes see and that are static with at least `min_probability`, each
/// once.
std::vector<LandmarkId> LandmarksOf(const MapSnapshot& map,
                                    const std::vector<KeyframeId>& keyframes,
                                    double min_probability);

/// Matches by descriptor alone between features of `keyframe` that show static landmarks and those
/// of `place`; each feature and each landmark once. Many may be wrong. Landmarks that both see say
/// nothing new and are left out.
std::vector<LoopMatch> MatchPlace(const MapSnapshot& map, const Keyframe& keyframe,
                                  const std::vector<KeyframeId>& place, double min_probability);

/// How a guided search is done.
struct LoopSearch {
  RigidTransform camera_from_world;   ///< of the keyframe
  double radius_px = 0;               ///< at octave 0
  int max_hamming = 0;                ///< [bits]
  double min_static_probability = 0;  ///< of the features
};

/// Matches `landmarks` (not seen by the keyframe) with its static features where they are expected;
/// each feature once.
std::vector<LoopMatch> SearchByProjection(const MeasurementModel& model, const Keyframe& keyframe,
                                          const std::vector<Landmark>& landmarks,
                                          const LoopSearch& search);

}  // namespace ofm
