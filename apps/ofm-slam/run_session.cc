#include "run_session.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "debug_video.h"
#include "ofm/base/error.h"
#include "ofm/io/camera_file.h"
#include "ofm/io/prefetching_source.h"
#include "ofm/io/trajectory_file.h"
#include "ofm/perception/make_segmenter.h"
#include "ofm/pipeline/paced_source.h"
#include "ofm/pipeline/runner.h"
#include "progress_bar.h"

namespace ofm {
namespace {

/// The sequence's frames, decoded ahead, at the recorded pace where that is asked for.
struct Source {
  std::unique_ptr<FrameSource> frames;
  PacedSource* paced = nullptr;
};

Source OpenSource(const RunSettings& settings, std::shared_ptr<const RgbdSequence> sequence) {
  Source source;
  source.frames = std::make_unique<PrefetchingSource>(
      std::make_unique<TumFrameSource>(std::move(sequence), settings.range));
  if (settings.realtime) {
    auto paced = std::make_unique<PacedSource>(std::move(source.frames), SteadyPacingClock());
    source.paced = paced.get();
    source.frames = std::move(paced);
  }
  return source;
}

/// The ground truth beside a sequence and how many of the run's frames have some.
struct Truth {
  Trajectory trajectory;
  EvaluationOptions options;
};

/// Empty where there is none. Throws Error where it cannot be read: better now than after the run.
std::optional<Truth> LoadTruth(const RgbdSequence& sequence, const FrameRange& range) {
  if (!sequence.groundtruth()) return {};
  Truth truth{LoadTrajectory(*sequence.groundtruth()), {}};
  std::vector<std::int64_t> stamps;
  const std::size_t first = range.first;
  const std::size_t count = range.max_count > 0 ? range.max_count : sequence.size();
  for (std::size_t i = first; i < std::min(sequence.size(), first + count); ++i) {
    stamps.push_back(sequence.entries()[i].color.stamp_ns);
  }
  truth.options.frames = CountInSpan(stamps, truth.trajectory);
  return truth;
}

/// Errors against ground truth; empty where there is none, or too few poses to compare.
std::optional<TrajectoryEvaluation> Evaluate(const std::optional<Truth>& truth,
                                             const Trajectory& estimate) {
  if (!truth || estimate.size() < 2) return {};
  try {
    return EvaluateTrajectory(estimate, truth->trajectory, truth->options);
  } catch (const Error& error) {
    spdlog::warn("no errors against ground truth: {}", error.what());
    return {};
  }
}

std::string FormatLoops(const RunOutcome& outcome) {
  const LoopCounts& counts = outcome.loop_counts;
  int fused = 0;
  for (const LoopRecord& loop : outcome.loops) fused += loop.landmarks_fused;
  return fmt::format(
      "loops       {} closed, {} landmarks fused; of {} similar keyframes {} were inconsistent, {} "
      "had few matches, {} no alignment, {} few inliers\n",
      counts.closed, fused, counts.similar, counts.inconsistent, counts.few_matches,
      counts.no_alignment, counts.few_inliers);
}

}  // namespace

RunReport RunSession(const RunSettings& settings, std::stop_token stop) {
  const PinholeCamera camera = ResolveCamera(settings.camera, settings.sequence);
  const auto sequence = std::make_shared<const RgbdSequence>(settings.sequence, camera);
  const std::optional<Truth> truth = LoadTruth(*sequence, settings.range);
  auto segmenter = MakeSegmenter(settings.options.perception, settings.sequence);
  Source source = OpenSource(settings, sequence);
  std::optional<CullingMeter> meter;
  if (!settings.true_masks.empty()) meter.emplace(settings.true_masks, settings.options.features);
  PrepareOutputFolder(settings.output);

  std::optional<DebugVideo> video;
  if (!settings.debug_video.empty()) {
    video.emplace(settings.debug_video, segmenter->class_names());
  }
  Slam slam(camera, settings.options, std::move(segmenter));
  RunReport report;
  {
    ProgressBar progress(source.frames->size());
    RunContext context;
    if (!settings.quiet) context.observers.push_back(&progress);
    if (video) context.observers.push_back(&*video);
    if (meter) context.observers.push_back(&*meter);
    context.stop = stop;
    report.outcome = settings.threaded || settings.realtime
                         ? RunThreaded(slam, *source.frames, context)
                         : RunSequential(slam, *source.frames, context);
  }
  if (report.outcome.counts.frames == 0 && !report.outcome.error.empty()) {
    throw Error(report.outcome.error);
  }
  if (source.paced != nullptr) report.outcome.counts.frames_dropped = source.paced->dropped();
  report.description.version = OFM_VERSION;
  report.description.input = settings.sequence.string();
  report.description.runner = settings.threaded || settings.realtime ? "threaded" : "sequential";
  report.description.camera = camera;
  if (meter) report.description.culling = meter->counts();
  report.description.evaluation = Evaluate(truth, report.outcome.trajectory);
  report.description.live_evaluation = Evaluate(truth, report.outcome.live_trajectory);
  WriteResults(settings.output, report.outcome, settings.options, report.description);
  return report;
}

std::string FormatSummary(const RunReport& report) {
  const RunOutcome& outcome = report.outcome;
  const RunCounts& counts = outcome.counts;
  std::string text;
  const double share =
      counts.frames == 0 ? 0 : 100.0 * static_cast<double>(counts.frames_tracked) / counts.frames;
  text += fmt::format("frames      {} tracked of {} ({:.1f} %), {} dropped, lost {} times\n",
                      counts.frames_tracked, counts.frames, share, counts.frames_dropped,
                      counts.losses);
  text += fmt::format("map         {} keyframes ({} made), {} landmarks, {} cloud points\n",
                      counts.keyframes, counts.keyframes_made, counts.landmarks,
                      outcome.semantic_map ? outcome.semantic_map->cloud_in_world.size() : 0);
  text += FormatLoops(outcome);
  text += fmt::format("culling     {:.1f} % of the pixels masked on average\n",
                      100 * counts.mean_masked_share);
  if (const auto& culling = report.description.culling) {
    text += fmt::format(
        "            of the features on true actors {:.2f} % reach the pose, of the others {:.1f} "
        "% are kept\n",
        100 * culling->ActorShareInPose(), 100 * culling->StaticShareKept());
  }
  text += fmt::format("time        {:.1f} s, {:.1f} frames/s, {:.1f} ms CPU per frame\n",
                      outcome.wall_s, outcome.wall_s > 0 ? counts.frames / outcome.wall_s : 0,
                      counts.frames > 0 ? 1e3 * outcome.process_cpu_s / counts.frames : 0);
  for (const auto& [stage, durations] : outcome.times.stages()) {
    const DurationStatistics cpu = Summarize(durations.cpu_ms);
    text += fmt::format("  {:<20} {:>6} x  median {:>8.2f} ms  p99 {:>8.2f} ms (CPU)\n", stage,
                        cpu.count, cpu.median_ms, cpu.p99_ms);
  }
  if (report.description.evaluation) {
    text += "\nagainst ground truth, after optimisation:\n";
    text += FormatEvaluation(*report.description.evaluation);
  }
  if (report.description.live_evaluation) {
    text += fmt::format("as known at the time of each frame: ATE rmse {:.4f} m\n",
                        report.description.live_evaluation->ate.translation_m.rmse);
  }
  return text;
}

}  // namespace ofm
