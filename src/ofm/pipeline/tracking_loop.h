// The part of a run that both runners share: tracking a prepared frame and keeping the books.
#pragma once

#include <optional>

#include "ofm/objects/track_log.h"
#include "ofm/pipeline/back_end.h"
#include "ofm/pipeline/runner.h"
#include "ofm/pipeline/trajectory_log.h"
#include "ofm/pipeline/view_collector.h"

namespace ofm {

/// Tracks frames and gathers what a run tells of them. Serves one thread.
class TrackingLoop {
 public:
  TrackingLoop(Slam& slam, const RunContext& context)
      : slam_(slam),
        context_(context),
        object_tracks_(slam.camera(), slam.options().objects.tracks),
        views_(slam.options().dense.cloud.view_stride) {}

  /// Tracks one frame against `map`; gives the keyframe to be mapped, if one is to be made.
  std::optional<KeyframeJob> Process(const PreparedFrame& prepared,
                                     std::shared_ptr<const MapSnapshot> map, int keyframes_waiting);

  /// Fills in trajectories, counts and times, once the back end has finished the map.
  void Finish(const BackEnd& back_end, RunOutcome& outcome);

 private:
  Slam& slam_;
  const RunContext& context_;
  TrajectoryLog log_;
  TrackLog object_tracks_;
  ViewCollector views_;
  std::vector<FrameRecord> frames_;
  StageTimes times_;
  std::vector<Sighting> sightings_;  // since the last keyframe
  std::size_t keyframes_made_ = 0, losses_ = 0, submaps_begun_ = 0;
  bool lost_ = false;
  double masked_sum_ = 0;
};

}  // namespace ofm
