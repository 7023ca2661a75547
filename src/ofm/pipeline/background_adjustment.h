// Bundle adjustment of the whole map while the map goes on growing.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <thread>

#include "ofm/base/timing.h"
#include "ofm/mapping/map_adjustment.h"

namespace ofm {

/// What one adjustment came to.
struct FinishedAdjustment {
  std::optional<MapCorrection> correction;  ///< empty where the solver failed
  StageTimes times;
};

/// Runs one adjustment at a time in a thread of its own. Serves one thread, which never waits for
/// it but where a method says so. The destructor cancels.
class BackgroundAdjustment {
 public:
  BackgroundAdjustment(const MeasurementModel& model, const BundleOptions& options)
      : model_(model), options_(options) {}

  /// Begins with a snapshot. One that is in progress is cancelled and forgotten; the call waits for
  /// the end of its iteration.
  void Start(std::shared_ptr<const MapSnapshot> map);
  /// What was finished since the last call, if anything. Throws what the thread threw.
  std::optional<FinishedAdjustment> Take();
  /// The same, but waits for what is in progress.
  std::optional<FinishedAdjustment> Wait();
  void Cancel();

 private:
  MeasurementModel model_;
  BundleOptions options_;
  std::future<FinishedAdjustment> result_;
  std::jthread thread_;
};

}  // namespace ofm
