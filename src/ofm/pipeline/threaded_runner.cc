#include <atomic>
#include <exception>
#include <stdexcept>
#include <thread>

#include "ofm/base/bounded_queue.h"
#include "ofm/base/latest.h"
#include "ofm/base/thread_priority.h"
#include "ofm/base/time.h"
#include "ofm/pipeline/back_end.h"
#include "ofm/pipeline/keep_error.h"
#include "ofm/pipeline/runner.h"
#include "ofm/pipeline/thread_urgency.h"
#include "ofm/pipeline/tracking_loop.h"

namespace ofm {
namespace {

constexpr std::size_t kFlowedFrames = 1;
constexpr std::size_t kPreparedFrames = 2;
constexpr std::size_t kKeyframeJobs = 8;

/// How a thread of a run ended. Written by it, read after it was joined.
struct ThreadEnd {
  std::string error;             ///< of the input or a library
  std::exception_ptr exception;  ///< a programmer's error
};

template <class Work>
ThreadEnd Guard(Work&& work) {
  ThreadEnd end;
  try {
    KeepError(end.error, std::forward<Work>(work));
  } catch (const std::logic_error&) {
    end.exception = std::current_exception();
  }
  return end;
}

/// What the threads of a run share.
struct Exchange {
  BoundedQueue<FlowedFrame> flowed{kFlowedFrames};
  BoundedQueue<PreparedFrame> prepared{kPreparedFrames};
  BoundedQueue<KeyframeJob> jobs{kKeyframeJobs};
  Latest<std::shared_ptr<const MapSnapshot>> map;  // null once the back end has failed
  std::atomic<int> keyframes_inserted = 0;         // that are in `map`
  StageTimes flow_times, perception_times;         // read after the threads were joined
};

/// Lets the threads end, however the scope is left.
struct QueueCloser {
  Exchange& exchange;
  ~QueueCloser() {
    exchange.flowed.Close();
    exchange.prepared.Close();
    exchange.jobs.Close();
  }
};

ThreadEnd RunFlow(Slam& slam, FrameSource& source, std::stop_token stop, Exchange& exchange) {
  ThreadEnd end = Guard([&] {
    while (!stop.stop_requested()) {
      std::optional<RgbdFrame> frame = source.Next();
      if (!frame) break;
      FlowedFrame flowed = slam.front_end().Flow(std::move(*frame), exchange.flow_times);
      if (!exchange.flowed.Push(std::move(flowed), stop)) break;
    }
  });
  exchange.flowed.Close();
  return end;
}

ThreadEnd RunPerception(Slam& slam, Exchange& exchange) {
  ThreadEnd end = Guard([&] {
    while (std::optional<FlowedFrame> flowed = exchange.flowed.Pop()) {
      PreparedFrame prepared =
          slam.front_end().Perceive(std::move(*flowed), exchange.perception_times);
      if (!exchange.prepared.Push(std::move(prepared))) break;
    }
  });
  exchange.flowed.Close();
  exchange.prepared.Close();
  return end;
}

ThreadEnd RunBackEnd(BackEnd& back_end, Exchange& exchange) {
  LowerThreadPriority(kMappingNiceness);
  ThreadEnd end = Guard([&] {
    while (std::optional<KeyframeJob> job = exchange.jobs.Pop()) {
      exchange.map.Set(back_end.Insert(std::move(*job)));
      ++exchange.keyframes_inserted;
      // Refining may wait while further keyframes do.
      if (exchange.jobs.size() == 0) exchange.map.Set(back_end.Refine());
      back_end.UpdateDenseMaps(exchange.map.Get());
    }
  });
  if (!end.error.empty() || end.exception) {
    exchange.jobs.Close();
    exchange.map.Set(nullptr);
  }
  return end;
}

/// Tracks what the front end prepared until that ends, or the back end has failed.
void Track(TrackingLoop& tracking, Exchange& exchange) {
  int keyframes_made = 0;
  while (std::optional<PreparedFrame> prepared = exchange.prepared.Pop()) {
    const int waiting = keyframes_made - exchange.keyframes_inserted;  // before the map is taken
    std::shared_ptr<const MapSnapshot> map = exchange.map.Get();
    if (!map) return;
    std::optional<KeyframeJob> job = tracking.Process(*prepared, std::move(map), waiting);
    if (!job) continue;
    const bool begins_submap = job->candidate.begins_submap;
    const FrameId frame_id = job->candidate.frame_id;
    exchange.jobs.Push(std::move(*job));
    ++keyframes_made;
    // Before a sub-map is there, there is nothing to track against.
    if (!begins_submap) continue;
    exchange.map.WaitUntil([&](const auto& value) {
      const Keyframe* latest = value ? value->keyframes.Find(value->latest_keyframe) : nullptr;
      return !value || (latest != nullptr && latest->frame_id == frame_id);
    });
  }
}

}  // namespace

RunOutcome RunThreaded(Slam& slam, FrameSource& source, const RunContext& context) {
  BackEnd back_end(slam, LoopAdjustment::kInBackground);
  return RunThreaded(slam, back_end, source, context);
}

RunOutcome RunThreaded(Slam& slam, BackEnd& back_end, FrameSource& source,
                       const RunContext& context) {
  RunOutcome outcome;
  const std::int64_t wall_start = SteadyTimeNs(), cpu_start = ProcessCpuTimeNs();
  TrackingLoop tracking(slam, context);
  Exchange exchange;
  exchange.map.Set(slam.mapper().Snapshot());
  ThreadEnd flow_end, perception_end, back_end_end;
  {
    std::jthread flow([&] { flow_end = RunFlow(slam, source, context.stop, exchange); });
    std::jthread perception([&] { perception_end = RunPerception(slam, exchange); });
    std::jthread mapping([&] { back_end_end = RunBackEnd(back_end, exchange); });
    const QueueCloser closer{exchange};
    Track(tracking, exchange);
  }
  for (const ThreadEnd& end : {flow_end, perception_end, back_end_end}) {
    if (end.exception) std::rethrow_exception(end.exception);
    if (outcome.error.empty()) outcome.error = end.error;
  }
  outcome.times.Merge(exchange.flow_times);
  outcome.times.Merge(exchange.perception_times);
  KeepError(outcome.error, [&] { back_end.Finish(outcome); });
  tracking.Finish(back_end, outcome);
  outcome.wall_s = NanosecondsToSeconds(SteadyTimeNs() - wall_start);
  outcome.process_cpu_s = NanosecondsToSeconds(ProcessCpuTimeNs() - cpu_start);
  return outcome;
}

}  // namespace ofm
