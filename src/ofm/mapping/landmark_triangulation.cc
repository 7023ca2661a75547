#include "ofm/mapping/landmark_triangulation.h"

namespace ofm {

std::vector<LandmarkId> TriangulateWithNeighbours(Map&, KeyframeId, const MeasurementModel&,
                                                  const MappingOptions&) {
  return {};
}

}  // namespace ofm
