#include <exception>
#include <stdexcept>

#include "ofm/base/time.h"
#include "ofm/pipeline/back_end.h"
#include "ofm/pipeline/runner.h"
#include "ofm/pipeline/tracking_loop.h"

namespace ofm {

RunOutcome RunSequential(Slam& slam, FrameSource& source, const RunContext& context) {
  RunOutcome outcome;
  const std::int64_t wall_start = SteadyTimeNs(), cpu_start = ProcessCpuTimeNs();
  TrackingLoop tracking(slam, context);
  BackEnd back_end(slam);
  std::shared_ptr<const MapSnapshot> map = slam.mapper().Snapshot();
  try {
    while (!context.stop.stop_requested()) {
      std::optional<RgbdFrame> frame = source.Next();
      if (!frame) break;
      const PreparedFrame prepared = slam.front_end().Process(std::move(*frame), outcome.times);
      std::optional<KeyframeJob> job = tracking.Process(prepared, map, 0);
      if (!job) continue;
      map = back_end.Insert(std::move(*job));
      map = back_end.Refine();
    }
  } catch (const std::logic_error&) {
    throw;
  } catch (const std::exception& error) {
    outcome.error = error.what();
  }
  back_end.Finish(outcome);
  tracking.Finish(back_end, outcome);
  outcome.wall_s = NanosecondsToSeconds(SteadyTimeNs() - wall_start);
  outcome.process_cpu_s = NanosecondsToSeconds(ProcessCpuTimeNs() - cpu_start);
  return outcome;
}

}  // namespace ofm
