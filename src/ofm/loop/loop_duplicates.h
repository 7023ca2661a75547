// Landmarks that a loop shows to be one.
#pragma once

#include "ofm/loop/loop_verifier.h"
#include "ofm/map/map_correction.h"

namespace ofm {

/// Adds to `correction`, which names the moves of all keyframes, in which features of the keyframes
/// about `loop.keyframe` landmarks of the place are seen.
void AddDuplicates(const MapSnapshot& map, const VerifiedLoop& loop, const MeasurementModel& model,
                   const LoopOptions& options, MapCorrection& correction);

}  // namespace ofm
