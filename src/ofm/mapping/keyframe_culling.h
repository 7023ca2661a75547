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

/// Bounds the map: where it holds over options.max_keyframes, the keyframes go of whose close
/// landmarks most are seen by most others (three count), until a sixteenth fewer are left, so that
/// all are ranked rarely. `current`, what shares landmarks with it, those that hold a sub-map's
/// world, and keyframes that share nothing with any other stay.
void RemoveKeyframesOverBudget(Map& map, KeyframeId current, const MeasurementModel& model,
                               const MappingOptions& options);

}  // namespace ofm
