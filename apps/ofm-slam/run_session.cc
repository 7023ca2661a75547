#include "run_session.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "debug_video.h"
#include "inpainting_writer.h"
#include "mask_writer.h"
#include "ofm/base/error.h"
#include "ofm/base/time.h"
#include "ofm/io/atomic_file.h"
#include "ofm/io/camera_file.h"
#include "ofm/io/prefetching_source.h"
#include "ofm/io/trajectory_file.h"
#include "ofm/map/map_file.h"
#include "ofm/map/submap.h"
#include "ofm/perception/make_segmenter.h"
#include "ofm/pipeline/delay_meter.h"
#include "ofm/pipeline/keyframe_images.h"
#include "ofm/pipeline/paced_source.h"
#include "ofm/pipeline/runner.h"
#include "ofm/pipeline/trajectory_log.h"
#include "ofm/view/live_view.h"
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
    auto paced = std::make_unique<PacedSource>(std::move(source.frames), SteadyPacingClock(),
                                               settings.realtime_queue);
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

/// Empty where there was never more than one.
std::string FormatSubmaps(const RunOutcome& outcome) {
  if (outcome.counts.submaps_begun == 0 && outcome.unjoined.empty()) return {};
  std::string text = fmt::format(
      "sub-maps    {} begun after a loss, {} joined to another by a place that both show\n",
      outcome.counts.submaps_begun, outcome.loop_counts.joined);
  if (outcome.unjoined.empty()) return text;
  std::size_t frames = 0;
  for (const UnjoinedSubmap& submap : outcome.unjoined) frames += submap.trajectory.size();
  return text + fmt::format(
                    "            results are of sub-map {}; {} more remain, {} of the frames "
                    "tracked are theirs (trajectory_submap_N.txt)\n",
                    outcome.submap.value, outcome.unjoined.size(), frames);
}

MapSettings SettingsOfMap(const PinholeCamera& camera, const OrbOptions& features) {
  return {camera, features.levels, features.scale_factor};
}

/// Null where no map is to be loaded.
std::shared_ptr<const MapSnapshot> LoadStartMap(const RunSettings& settings,
                                                const PinholeCamera& camera) {
  if (settings.load_map.empty()) return nullptr;
  const StoredMap stored = LoadMap(settings.load_map, ResolveVocabulary(settings.options));
  RequireSameSettings(settings.load_map, stored.settings,
                      SettingsOfMap(camera, settings.options.features));
  return stored.map;
}

/// Null where none is asked for.
std::unique_ptr<LiveView> OpenView(const RunSettings& settings, const PinholeCamera& camera,
                                   const Segmenter& segmenter, const FrameSource& frames) {
  if (!settings.view) return nullptr;
  LiveViewOptions options;
  options.server = settings.view_server;
  auto view = std::make_unique<LiveView>(options, camera, segmenter.class_names(), frames.size());
  fmt::print(stderr, "live view at {}\n", view->url());
  return view;
}

/// Errors in the world of `map`, where the ground truth is known for its keyframes too.
std::optional<TrajectoryEvaluation> EvaluateInMap(std::optional<Truth> truth,
                                                  const MapSnapshot* map,
                                                  const Trajectory& estimate) {
  if (!truth || map == nullptr) return {};
  try {
    truth->options.truth_from_estimate =
        ComputeAte(KeyframeTrajectory(*map, LargestSubmap(*map)), truth->trajectory)
            .truth_from_estimate;
  } catch (const Error&) {
    return {};  // the map is of another time
  }
  return Evaluate(truth, estimate);
}

void SaveFinalMap(const RunSettings& settings, const PinholeCamera& camera, RunReport& report) {
  if (settings.save_map.empty()) return;
  if (!report.outcome.map_is_whole) {
    throw Error(settings.save_map, "is not written: an error cut mapping short (" +
                                       report.outcome.error + "); other results are in " +
                                       settings.output.string());
  }
  const std::int64_t start_ns = SteadyTimeNs();
  SaveMap(settings.save_map, *report.outcome.map, SettingsOfMap(camera, settings.options.features));
  report.map_saving_s = NanosecondsToSeconds(SteadyTimeNs() - start_ns);
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
  const std::shared_ptr<const MapSnapshot> start_map = LoadStartMap(settings, camera);
  PrepareOutputFolder(settings.output);
  if (!settings.save_map.empty()) RequireWritable(settings.save_map);

  std::optional<DebugVideo> video;
  if (!settings.debug_video.empty()) {
    video.emplace(settings.debug_video, segmenter->class_names());
  }
  std::optional<MaskWriter> mask_writer;
  if (!settings.write_masks.empty()) {
    mask_writer.emplace(settings.write_masks, segmenter->class_names());
  }
  std::optional<HiddenPixelRecorder> hidden;
  if (!settings.write_inpainted.empty()) hidden.emplace(settings.write_inpainted);
  std::unique_ptr<LiveView> view = OpenView(settings, camera, *segmenter, *source.frames);
  KeyframeImages keyframe_images(settings.options.keyframe_images);
  std::optional<DelayMeter> delays;
  if (source.paced != nullptr) delays.emplace(*source.paced, SteadyPacingClock());
  Slam slam(camera, settings.options, std::move(segmenter), start_map);
  RunReport report;
  {
    ProgressBar progress(source.frames->size());
    RunContext context;
    if (!settings.quiet) context.observers.push_back(&progress);
    if (video) context.observers.push_back(&*video);
    if (meter) context.observers.push_back(&*meter);
    if (mask_writer) context.observers.push_back(&*mask_writer);
    if (hidden) context.observers.push_back(&*hidden);
    if (view) context.observers.push_back(view.get());
    context.observers.push_back(&keyframe_images);
    if (delays) context.observers.push_back(&*delays);
    context.stop = stop;
    report.outcome = settings.threaded || settings.realtime
                         ? RunThreaded(slam, *source.frames, context)
                         : RunSequential(slam, *source.frames, context);
  }
  if (report.outcome.counts.frames == 0 && !report.outcome.error.empty()) {
    throw Error(report.outcome.error);
  }
  if (view) view->ShowMap(report.outcome.map);
  view.reset();
  if (source.paced != nullptr) report.outcome.counts.frames_dropped = source.paced->dropped();
  report.description.version = OFM_VERSION;
  report.description.input = settings.sequence.string();
  report.description.runner = settings.threaded || settings.realtime ? "threaded" : "sequential";
  report.description.loaded_map = settings.load_map.string();
  report.description.saved_map = settings.save_map.string();
  report.description.camera = camera;
  if (meter) report.description.culling = meter->counts();
  if (delays) report.description.pose_delays = delays->delays();
  report.description.evaluation = Evaluate(truth, report.outcome.trajectory);
  report.description.live_evaluation = Evaluate(truth, report.outcome.live_trajectory);
  report.description.evaluation_in_map =
      EvaluateInMap(truth, start_map.get(), report.outcome.trajectory);
  WriteResults(settings.output, report.outcome, settings.options, report.description);
  WriteKeyframeImages(settings.output / "keyframes", keyframe_images.images());
  SaveFinalMap(settings, camera, report);
  if (hidden) {
    WriteInpaintedFrames(settings.write_inpainted, *sequence, report.outcome,
                         settings.options.dense, stop);
  }
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
  if (outcome.objects) {
    text += fmt::format("objects     {}, and {} tracks of what may move (ofm-slam objects)\n",
                        outcome.objects->objects.size(), outcome.objects->tracks.size());
  }
  text += FormatLoops(outcome);
  text += FormatSubmaps(outcome);
  const RunDescription& description = report.description;
  if (!description.loaded_map.empty()) {
    text += fmt::format("loaded map  {}{}\n", description.loaded_map,
                        outcome.trajectory.empty() ? ": its place was never recognised" : "");
  }
  if (!description.saved_map.empty()) {
    text +=
        fmt::format("saved map   {}, {:.1f} MB in {:.2f} s\n", description.saved_map,
                    1e-6 * static_cast<double>(std::filesystem::file_size(description.saved_map)),
                    report.map_saving_s);
  }
  text += fmt::format("culling     {:.1f} % of the pixels masked on average\n",
                      100 * counts.mean_masked_share);
  if (const auto& culling = description.culling) {
    text += fmt::format(
        "            of the features on true actors {:.2f} % reach the pose, of the others {:.1f} "
        "% are kept\n",
        100 * culling->ActorShareInPose(), 100 * culling->StaticShareKept());
  }
  text += fmt::format("time        {:.1f} s, {:.1f} frames/s, {:.1f} ms CPU per frame\n",
                      outcome.wall_s, outcome.wall_s > 0 ? counts.frames / outcome.wall_s : 0,
                      counts.frames > 0 ? 1e3 * outcome.process_cpu_s / counts.frames : 0);
  if (const auto& delays = description.pose_delays) {
    text += fmt::format(
        "delay       from a frame to its pose {:.0f} ms (median), {:.0f} ms (p99), {:.0f} ms at "
        "most\n",
        delays->median_ms, delays->p99_ms, delays->max_ms);
  }
  for (const auto& [stage, durations] : outcome.times.stages()) {
    const DurationStatistics cpu = Summarize(durations.cpu_ms);
    text += fmt::format("  {:<20} {:>6} x  median {:>8.2f} ms  p99 {:>8.2f} ms (CPU)\n", stage,
                        cpu.count, cpu.median_ms, cpu.p99_ms);
  }
  if (description.evaluation) {
    text += "\nagainst ground truth, after optimisation:\n";
    text += FormatEvaluation(*description.evaluation);
  }
  if (description.evaluation_in_map) {
    text += fmt::format("in the loaded map's world, aligned by its keyframes: ATE rmse {:.4f} m\n",
                        description.evaluation_in_map->ate.translation_m.rmse);
  }
  if (description.live_evaluation) {
    text += fmt::format("as known at the time of each frame: ATE rmse {:.4f} m\n",
                        description.live_evaluation->ate.translation_m.rmse);
  }
  return text;
}

}  // namespace ofm
