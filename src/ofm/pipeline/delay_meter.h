// How late poses come at the camera's pace.
#pragma once

#include <vector>

#include "ofm/base/timing.h"
#include "ofm/pipeline/paced_source.h"
#include "ofm/pipeline/run_observer.h"

namespace ofm {

/// Measures for each frame the time from when it was due to when it was tracked, its wait for
/// frames before it included. `source` must outlive it; `clock` is that of `source`.
class DelayMeter : public RunObserver {
 public:
  DelayMeter(const PacedSource& source, PacingClock clock);

  void OnFrame(const FrameReport& report) override;
  DurationStatistics delays() const { return Summarize(delays_ms_); }

 private:
  const PacedSource& source_;
  PacingClock clock_;
  std::vector<double> delays_ms_;
};

}  // namespace ofm
