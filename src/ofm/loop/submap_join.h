// What it means for the map that two sub-maps show one place.
#pragma once

#include "ofm/loop/loop_verifier.h"
#include "ofm/map/map_correction.h"

namespace ofm {

/// Moves `join.from` rigidly into the world of `join.into`, by a place of the one that a keyframe
/// of the other shows; and the duplicates that the place shows. Nothing else moves.
MapCorrection ComputeSubmapJoin(const MapSnapshot& map, const VerifiedLoop& loop,
                                const SubmapJoin& join, const MeasurementModel& model,
                                const LoopOptions& options);

}  // namespace ofm
