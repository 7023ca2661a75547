// CPU time of the tracking thread per frame: features, matching and pose, without decoding and
// without mapping.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <opencv2/features2d.hpp>

#include "ofm/base/timing.h"
#include "ofm/io/camera_file.h"
#include "ofm/io/tum_sequence.h"
#include "ofm/mapping/mapper.h"
#include "ofm/pipeline/options.h"
#include "ofm/sim/sim_sequence.h"
#include "ofm/tracking/tracker.h"

namespace ofm {
namespace {

constexpr int kMaxFrames = 240;

struct Recording {
  PinholeCamera camera;
  std::vector<RgbdFrame> frames;
};

/// The real sequence where it is there, a simulated one otherwise; 640x480.
Recording LoadRecording() {
  Recording recording;
  const std::filesystem::path folder = OFM_SHARED_DIR "/data/tum_fr1_desk";
  if (std::filesystem::exists(folder)) {
    recording.camera = ResolveCamera("tum-fr1", folder);
    const RgbdSequence sequence(folder, recording.camera);
    const std::size_t count = std::min<std::size_t>(kMaxFrames, sequence.size());
    for (std::size_t i = 0; i < count; ++i) recording.frames.push_back(sequence.Load(i));
    return recording;
  }
  SimSequenceOptions options;
  options.frames = 60;
  options.camera = MakeSimCamera(640, 480);
  SimSequence sequence(options);
  recording.camera = options.camera;
  while (auto frame = sequence.Next()) recording.frames.push_back(std::move(*frame));
  return recording;
}

/// Milliseconds of CPU that each frame took to track; mapping runs in between and is not counted.
std::vector<double> TrackAll(const Recording& recording, const SlamOptions& options) {
  const MeasurementModel model{recording.camera,
                               OctaveScales(options.features.levels, options.features.scale_factor),
                               options.measurement};
  OrbExtractor extractor(options.features);
  Tracker tracker(model, options.tracking, options.seed);
  Mapper mapper(model, options.mapping);
  auto map = mapper.Snapshot();
  std::vector<Sighting> sightings;
  std::vector<double> durations_ms;
  for (const RgbdFrame& frame : recording.frames) {
    const std::int64_t start_ns = ThreadCpuTimeNs();
    TrackingInput input;
    input.frame_id = frame.id;
    input.stamp_ns = frame.stamp_ns;
    input.depth_m = frame.depth_m;
    input.depth_stamp_ns = frame.depth_stamp_ns;
    input.features =
        MakeFrameFeatures(extractor.Extract(frame.gray), frame.depth_m, recording.camera);
    input.map = map;
    TrackingResult result = tracker.Process(input);
    durations_ms.push_back(static_cast<double>(ThreadCpuTimeNs() - start_ns) * 1e-6);
    sightings.insert(sightings.end(), result.sightings.begin(), result.sightings.end());
    if (!result.keyframe) continue;
    mapper.Insert(*result.keyframe, sightings);
    sightings.clear();
    mapper.Refine();
    map = mapper.Snapshot();
  }
  return durations_ms;
}

/// The same frames through cv::ORB with as many features: a yardstick of this machine, in this run.
std::vector<double> ExtractAllWithOpenCv(const Recording& recording) {
  const auto orb = cv::ORB::create(1000, 1.2F, 8);
  std::vector<double> durations_ms;
  for (const RgbdFrame& frame : recording.frames) {
    const std::int64_t start_ns = ThreadCpuTimeNs();
    std::vector<cv::KeyPoint> keypoints;
    cv::Mat descriptors;
    orb->detectAndCompute(frame.gray, cv::noArray(), keypoints, descriptors);
    durations_ms.push_back(static_cast<double>(ThreadCpuTimeNs() - start_ns) * 1e-6);
  }
  return durations_ms;
}

void BM_TrackFrame(benchmark::State& state) {
  cv::setNumThreads(1);
  const Recording recording = LoadRecording();
  DurationStatistics ours, yardstick;
  for (auto _ : state) {
    ours = Summarize(TrackAll(recording, SlamOptions()));
    yardstick = Summarize(ExtractAllWithOpenCv(recording));
  }
  state.counters["frames"] = static_cast<double>(ours.count);
  state.counters["track_median_ms"] = ours.median_ms;
  state.counters["track_p99_ms"] = ours.p99_ms;
  state.counters["cv_orb_median_ms"] = yardstick.median_ms;
  state.counters["ratio"] = ours.median_ms / yardstick.median_ms;
}
BENCHMARK(BM_TrackFrame)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ofm
