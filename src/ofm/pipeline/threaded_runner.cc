#include <exception>
#include <thread>

#include "ofm/base/bounded_queue.h"
#include "ofm/base/latest.h"
#include "ofm/base/time.h"
#include "ofm/pipeline/back_end.h"
#include "ofm/pipeline/runner.h"
#include "ofm/pipeline/tracking_loop.h"

namespace ofm {
namespace {

constexpr std::size_t kPreparedFrames = 2;
constexpr std::size_t kKeyframeJobs = 8;

/// What the threads of a run share.
struct Exchange {
  BoundedQueue<PreparedFrame> prepared{kPreparedFrames};
  BoundedQueue<KeyframeJob> jobs{kKeyframeJobs};
  Latest<std::shared_ptr<const MapSnapshot>> map;
  std::string error;           // written by the front end's thread, read after it was joined
  StageTimes front_end_times;  // likewise
};

/// Lets the threads end, however the scope is left.
struct QueueCloser {
  Exchange& exchange;
  ~QueueCloser() {
    exchange.prepared.Close();
    exchange.jobs.Close();
  }
};

void RunFrontEnd(Slam& slam, FrameSource& source, std::stop_token stop, Exchange& exchange) {
  try {
    while (!stop.stop_requested()) {
      std::optional<RgbdFrame> frame = source.Next();
      if (!frame) break;
      PreparedFrame prepared =
          slam.front_end().Process(std::move(*frame), exchange.front_end_times);
      if (!exchange.prepared.Push(std::move(prepared), stop)) break;
    }
  } catch (const std::runtime_error& error) {
    exchange.error = error.what();
  }
  exchange.prepared.Close();
}

void RunBackEnd(BackEnd& back_end, Exchange& exchange) {
  while (std::optional<KeyframeJob> job = exchange.jobs.Pop()) {
    exchange.map.Set(back_end.Insert(std::move(*job)));
    // Refining may wait while further keyframes do.
    if (exchange.jobs.size() == 0) exchange.map.Set(back_end.Refine());
  }
}

}  // namespace

RunOutcome RunThreaded(Slam& slam, FrameSource& source, const RunContext& context) {
  RunOutcome outcome;
  const std::int64_t wall_start = SteadyTimeNs(), cpu_start = ProcessCpuTimeNs();
  TrackingLoop tracking(slam, context);
  BackEnd back_end(slam);
  Exchange exchange;
  exchange.map.Set(slam.mapper().Snapshot());
  {
    std::jthread front_end([&] { RunFrontEnd(slam, source, context.stop, exchange); });
    std::jthread mapping([&] { RunBackEnd(back_end, exchange); });
    const QueueCloser closer{exchange};
    while (std::optional<PreparedFrame> prepared = exchange.prepared.Pop()) {
      const int waiting = static_cast<int>(exchange.jobs.size());
      std::optional<KeyframeJob> job = tracking.Process(*prepared, exchange.map.Get(), waiting);
      if (!job) continue;
      const bool first = !job->candidate.reference.valid();
      exchange.jobs.Push(std::move(*job));
      // Without a map there is nothing to track against: wait for the first one.
      if (first) exchange.map.WaitUntil([](const auto& map) { return map->keyframe_count > 0; });
    }
  }
  outcome.error = exchange.error;
  outcome.times.Merge(exchange.front_end_times);
  back_end.Finish(outcome);
  tracking.Finish(back_end, outcome);
  outcome.wall_s = NanosecondsToSeconds(SteadyTimeNs() - wall_start);
  outcome.process_cpu_s = NanosecondsToSeconds(ProcessCpuTimeNs() - cpu_start);
  return outcome;
}

}  // namespace ofm
