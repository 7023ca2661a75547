// Sinks on the pipeline: progress bars, recorders, viewers.
#pragma once

#include "ofm/pipeline/front_end.h"
#include "ofm/tracking/tracking_types.h"

namespace ofm {

/// What is told about a frame once it was tracked.
struct FrameReport {
  const PreparedFrame& prepared;
  const TrackingResult& tracking;
  std::size_t frames_done = 0;
  std::size_t keyframes = 0, landmarks = 0;
  /// That it was tracked against; null before there is one.
  std::shared_ptr<const MapSnapshot> map = {};
};

/// Called from the tracking thread; must return soon.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  virtual void OnFrame(const FrameReport& report) = 0;
};

}  // namespace ofm
