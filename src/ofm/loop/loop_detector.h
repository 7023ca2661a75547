// Which earlier keyframes may show the place that a new one shows.
#pragma once

#include <set>
#include <vector>

#include "ofm/features/place_database.h"
#include "ofm/loop/options.h"
#include "ofm/map/map.h"

namespace ofm {

/// What the detector found of one keyframe.
struct LoopCandidates {
  int similar = 0;  ///< keyframes that look alike enough
  std::vector<KeyframeId>
      consistent;  ///< of these, those that others in a row agree with; best first
};

/// Candidates by appearance, with the checks of Mur-Artal and Tardos (Fast Relocalisation and Loop
/// Closing in Keyframe-Based SLAM, ICRA 2014, section V-A): no neighbour of the keyframe (nor one
/// of its neighbours'), about as similar as its best neighbour, and of neighbouring places over
/// several keyframes in a row, all of one sub-map.
class LoopDetector {
 public:
  explicit LoopDetector(const LoopOptions& options) : options_(options) {}

  /// Candidates for keyframe `id` of `map`, which shows `words`. Keyframes come in increasing order
  /// of id and are candidates of later ones.
  LoopCandidates Detect(const MapSnapshot& map, KeyframeId id, const BagOfWords& words);
  /// Puts a keyframe into the database without looking for loops; ends the row.
  void Add(KeyframeId id, const BagOfWords& words);

 private:
  /// Neighbouring keyframes that the last one may show again.
  struct Row {
    std::set<KeyframeId> places;
    int keyframes = 0;  ///< in a row that saw them
  };

  std::vector<KeyframeId> FindSimilar(const MapSnapshot& map, KeyframeId id,
                                      const BagOfWords& words);

  LoopOptions options_;
  PlaceDatabase database_;
  std::vector<Row> rows_;  // of the last keyframe
  KeyframeId last_;
};

}  // namespace ofm
