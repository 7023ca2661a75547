// What a loop means for the whole map.
#pragma once

#include <optional>
#include <vector>

#include "ofm/loop/loop_verifier.h"
#include "ofm/map/map_correction.h"

namespace ofm {

/// Two keyframes that a loop joined.
struct ClosedLoop {
  KeyframeId keyframe, place;
};

/// Poses of the keyframes of the loop's sub-map after a pose graph over the essential graph, the
/// earlier loops and this one (Strasdat, Davison, Montiel and Konolige, Double Window Optimisation,
/// ICCV 2011; Mur-Artal and Tardos 2014), with its oldest keyframe fixed; and the duplicates that
/// the loop shows. Landmarks move with their keyframes. Empty where the solver failed.
std::optional<MapCorrection> ComputeLoopCorrection(const MapSnapshot& map, const VerifiedLoop& loop,
                                                   const std::vector<ClosedLoop>& earlier,
                                                   const MeasurementModel& model,
                                                   const LoopOptions& options);

}  // namespace ofm
