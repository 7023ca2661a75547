// The mapping stage: landmarks and keyframes.
#pragma once

#include <stop_token>
#include <vector>

#include "ofm/map/map_correction.h"
#include "ofm/mapping/options.h"
#include "ofm/tracking/measurement.h"
#include "ofm/tracking/tracking_types.h"

namespace ofm {

/// Owns the map. Serves one thread; others read snapshots.
class Mapper {
 public:
  /// Goes on with the map of `start`.
  Mapper(const MeasurementModel& model, const MappingOptions& options,
         const MapSnapshot& start = {});

  /// Puts the candidate into the map with landmarks from its depth, so that tracking can use them
  /// at once. `sightings` are those of the frames since the last keyframe.
  KeyframeId Insert(const KeyframeCandidate& candidate, const std::vector<Sighting>& sightings);
  /// Culls, triangulates, fuses, adjusts and removes redundant keyframes about the newest one.
  /// Where `stop` is requested the adjustment is left out.
  void Refine(std::stop_token stop = {});
  /// Bundle adjustment over the whole map.
  void AdjustAll(std::stop_token stop = {});
  /// Takes over what was found out about an earlier snapshot.
  CorrectionReport Apply(const MapCorrection& correction);

  const Map& map() const { return map_; }
  std::shared_ptr<const MapSnapshot> Snapshot() { return map_.Snapshot(); }

 private:
  struct YoungLandmark {
    LandmarkId id;
    KeyframeId made_by;
  };

  void RemoveMoving(const std::vector<Sighting>& sightings);
  void CreateFromDepth(KeyframeId id);
  void CullYoung(KeyframeId current);

  MeasurementModel model_;
  MappingOptions options_;
  Map map_;
  std::vector<YoungLandmark> young_;
};

}  // namespace ofm
