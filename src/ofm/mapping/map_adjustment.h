// Bundle adjustment of a part of the map, or of all of it.
#pragma once

#include <optional>
#include <stop_token>

#include "ofm/map/map_correction.h"
#include "ofm/mapping/options.h"
#include "ofm/tracking/measurement.h"

namespace ofm {

/// Adjusts `current`, the keyframes that share most landmarks with it and the landmarks that they
/// see; other observers of these stay fixed. Observations over the gate leave the map.
void AdjustLocally(Map& map, KeyframeId current, const MeasurementModel& model,
                   const MappingOptions& options, std::stop_token stop = {});

/// What adjusting all keyframes but one of each sub-map (FindWorldHolder) and all landmarks of a
/// snapshot comes to; empty where the solver failed or `stop` was requested. May run while the map
/// is changed.
std::optional<MapCorrection> ComputeWholeAdjustment(const MapSnapshot& map,
                                                    const MeasurementModel& model,
                                                    const BundleOptions& bundle,
                                                    std::stop_token stop = {});

/// The same on the map itself.
void AdjustWholeMap(Map& map, const MeasurementModel& model, const MappingOptions& options,
                    std::stop_token stop = {});

}  // namespace ofm
