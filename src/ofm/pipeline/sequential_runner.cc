#include "ofm/base/time.h"
#include "ofm/pipeline/back_end.h"
#include "ofm/pipeline/keep_error.h"
#include "ofm/pipeline/runner.h"
#include "ofm/pipeline/tracking_loop.h"

namespace ofm {

RunOutcome RunSequential(Slam& slam, FrameSource& source, const RunContext& context) {
  BackEnd back_end(slam);
  return RunSequential(slam, back_end, source, context);
}

RunOutcome RunSequential(Slam& slam, BackEnd& back_end, FrameSource& source,
                         const RunContext& context) {
  RunOutcome outcome;
  const std::int64_t wall_start = SteadyTimeNs(), cpu_start = ProcessCpuTimeNs();
  TrackingLoop tracking(slam, context);
  std::shared_ptr<const MapSnapshot> map = slam.mapper().Snapshot();
  KeepError(outcome.error, [&] {
    while (!context.stop.stop_requested()) {
      std::optional<RgbdFrame> frame = source.Next();
      if (!frame) break;
      const PreparedFrame prepared = slam.front_end().Process(std::move(*frame), outcome.times);
      std::optional<KeyframeJob> job = tracking.Process(prepared, map, 0);
      if (!job) continue;
      map = back_end.Insert(std::move(*job));
      map = back_end.Refine();
      back_end.UpdateDenseMaps(map);
    }
  });
  KeepError(outcome.error, [&] { back_end.Finish(outcome); });
  tracking.Finish(back_end, outcome);
  outcome.wall_s = NanosecondsToSeconds(SteadyTimeNs() - wall_start);
  outcome.process_cpu_s = NanosecondsToSeconds(ProcessCpuTimeNs() - cpu_start);
  return outcome;
}

}  // namespace ofm
