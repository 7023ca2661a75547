#include "ofm/pipeline/background_adjustment.h"

#include <chrono>

#include "ofm/base/thread_priority.h"
#include "ofm/pipeline/thread_urgency.h"

namespace ofm {
namespace {

FinishedAdjustment Adjust(const MapSnapshot& map, const MeasurementModel& model,
                          const BundleOptions& options, const std::stop_token& stop) {
  FinishedAdjustment finished;
  ScopedStageTimer timer(finished.times, "loop_adjustment");
  finished.correction = ComputeWholeAdjustment(map, model, options, stop);
  return finished;
}

}  // namespace

void BackgroundAdjustment::Start(std::shared_ptr<const MapSnapshot> map) {
  Cancel();
  std::packaged_task<FinishedAdjustment(std::stop_token)> task(
      [map = std::move(map), model = model_, options = options_](const std::stop_token& stop) {
        LowerThreadPriority(kAdjustmentNiceness);
        return Adjust(*map, model, options, stop);
      });
  result_ = task.get_future();
  thread_ = std::jthread(std::move(task));
}

std::optional<FinishedAdjustment> BackgroundAdjustment::Take() {
  if (!result_.valid() || result_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return {};
  }
  return result_.get();
}

std::optional<FinishedAdjustment> BackgroundAdjustment::Wait() {
  if (!result_.valid()) return {};
  return result_.get();
}

void BackgroundAdjustment::Cancel() {
  thread_ = std::jthread();  // asks the old one to stop, and joins it
  result_ = {};
}

}  // namespace ofm
