// Landmarks for features whose depth was not measured, from two views.
#pragma once

#include <vector>

#include "ofm/map/map.h"
#include "ofm/mapping/options.h"
#include "ofm/tracking/measurement.h"

namespace ofm {

/// Matches features of `current` that show no landmark and have no usable depth with such features
/// of its neighbours along epipolar lines and triangulates them. Adds what has parallax, lies
/// before both cameras, no nearer than all that has depth, and reprojects within the gate: a wrong
/// match on a line seems near, and what is near decides where the camera is. Returns the new
/// landmarks.
std::vector<LandmarkId> TriangulateWithNeighbours(Map& map, KeyframeId current,
                                                  const MeasurementModel& model,
                                                  const MappingOptions& options);

}  // namespace ofm
