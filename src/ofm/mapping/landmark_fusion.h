// The same point of the world must not be two landmarks.
#pragma once

#include "ofm/map/map.h"
#include "ofm/mapping/options.h"
#include "ofm/tracking/measurement.h"

namespace ofm {

/// Projects the landmarks of `current` into its neighbours and theirs into it. Where the feature
/// found is free, the landmark gains an observation; where it shows another landmark, the two are
/// fused into the one with more observations. Returns how many were fused.
int FuseWithNeighbours(Map& map, KeyframeId current, const MeasurementModel& model,
                       const MappingOptions& options);

}  // namespace ofm
