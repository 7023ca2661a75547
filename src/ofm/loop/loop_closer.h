// The loop closing stage: places that were seen before.
#pragma once

#include <optional>
#include <vector>

#include "ofm/loop/loop_correction.h"
#include "ofm/loop/loop_detector.h"

namespace ofm {

/// What became of the keyframes; each candidate is counted at the step that it fails at.
struct LoopCounts {
  std::size_t keyframes = 0;  ///< in which a loop was looked for
  std::size_t similar = 0;    ///< pairs of keyframes that look alike
  std::size_t inconsistent = 0, few_matches = 0, no_alignment = 0, few_inliers = 0;  ///< rejected
  std::size_t closed = 0;  ///< within a sub-map
  std::size_t joined = 0;  ///< sub-maps that became part of another one
};

/// A loop, or a place that two sub-maps show, and what it means for the map.
struct LoopClosure {
  VerifiedLoop loop;
  MapCorrection correction;
};

/// Looks for loops, keyframe by keyframe, by the words that each has. Serves one thread.
class LoopCloser {
 public:
  /// `seed` decides all random draws, together with the keyframe's id. Of two sub-maps the older
  /// one keeps its world, but `fixed_world` always does.
  LoopCloser(const MeasurementModel& model, const LoopOptions& options, std::uint64_t seed,
             SubmapId fixed_world = {});

  /// Looks for a loop at keyframe `id` of `map`; keyframes come in increasing order of id. What is
  /// found counts as closed: the caller applies the correction. Keyframes before the first one, of
  /// a map that was loaded, are places too. A place of another sub-map joins the two.
  std::optional<LoopClosure> Process(const MapSnapshot& map, KeyframeId id);

  const LoopCounts& counts() const { return counts_; }

 private:
  void LearnLoadedMap(const MapSnapshot& map, KeyframeId first);
  std::optional<VerifiedLoop> Verify(const MapSnapshot& map, KeyframeId id,
                                     const std::vector<KeyframeId>& candidates);
  std::optional<MapCorrection> Correct(const MapSnapshot& map, const VerifiedLoop& loop);

  MeasurementModel model_;
  LoopOptions options_;
  std::uint64_t seed_;
  SubmapId fixed_world_;
  LoopDetector detector_;
  std::vector<ClosedLoop> closed_;
  int keyframes_since_loop_;
  bool knows_loaded_map_ = false;
  LoopCounts counts_;
};

}  // namespace ofm
