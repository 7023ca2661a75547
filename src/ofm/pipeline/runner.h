// Runs a system over a source of frames.
#pragma once

#include <stop_token>
#include <vector>

#include "ofm/io/frame_source.h"
#include "ofm/pipeline/run_observer.h"
#include "ofm/pipeline/run_outcome.h"
#include "ofm/pipeline/slam.h"

namespace ofm {

class BackEnd;

/// Who watches a run, and may end it.
struct RunContext {
  std::vector<RunObserver*> observers;  ///< not owned
  std::stop_token stop;                 ///< ends the run early with all results up to then
};

/// One frame after the other, every stage in the calling thread: the same frames, options and seed
/// give the same bytes. Where the source or a stage fails, the run ends: what was computed before
/// is in the outcome, with the error. A programmer's error (std::logic_error) is thrown.
RunOutcome RunSequential(Slam& slam, FrameSource& source, const RunContext& context);

/// Front end, tracking and mapping in threads of their own, joined by bounded queues: tracking
/// never waits for mapping. Otherwise as RunSequential.
RunOutcome RunThreaded(Slam& slam, FrameSource& source, const RunContext& context);

/// The same with a back end of `slam` that the caller gives.
RunOutcome RunSequential(Slam& slam, BackEnd& back_end, FrameSource& source,
                         const RunContext& context);
RunOutcome RunThreaded(Slam& slam, BackEnd& back_end, FrameSource& source,
                       const RunContext& context);

}  // namespace ofm
