// Keyframes that tell nothing new.
#pragma once

#include "ofm/map/map.h"
#include "ofm/mapping/options.h"
#include "ofm/tracking/measurement.h"

namespace ofm {

/// Removes neighbours of `current` of whose close landmarks at least options.redundant_share are
/// seen by three other keyframes at the same or a finer scale (Mur-Artal et al. 2015). The first
/// keyframe and `current` stay.
void RemoveRedundantKeyframes(Map& map, KeyframeId current, const MeasurementModel& model,
                              const MappingOptions& options);

}  // namespace ofm
