// What closing loops does on a recording, when tracking forgets: it knows the newest keyframes alone, so
// that the way drifts and places come back unrecognised, as on a long way that ends where it began.
//   ofm_measure_loop_closing SEQUENCE CAMERA MEMORY [option=value ...]
// MEMORY is the number of keyframes that tracking knows; after a loop it knows all again. Prints the
// error against ground truth without and with loop closing, and of every loop its own error.
#include <fmt/core.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core/utility.hpp>

#include "ofm/base/error.h"
#include "ofm/eval/evaluation.h"
#include "ofm/io/camera_file.h"
#include "ofm/io/prefetching_source.h"
#include "ofm/io/trajectory_file.h"
#include "ofm/io/tum_sequence.h"
#include "ofm/perception/make_segmenter.h"
#include "ofm/pipeline/back_end.h"
#include "ofm/pipeline/runner.h"

namespace ofm {
namespace {

/// A back end that tells tracking of the newest keyframes only, until a loop was closed.
class ForgetfulBackEnd final : public BackEnd {
 public:
  ForgetfulBackEnd(Slam& slam, std::uint32_t memory)
      : BackEnd(slam), slam_(slam), memory_(memory) {}

  std::shared_ptr<const MapSnapshot> Insert(KeyframeJob job) override {
    return Forget(BackEnd::Insert(std::move(job)));
  }
  std::shared_ptr<const MapSnapshot> Refine(std::stop_token stop) override {
    return Forget(BackEnd::Refine(std::move(stop)));
  }

 private:
  std::shared_ptr<const MapSnapshot> Forget(std::shared_ptr<const MapSnapshot> map) const {
    if (slam_.loop_closer().counts().closed > 0) return map;
    const auto is_known = [&](KeyframeId id) {
      return id.value + memory_ > map->latest_keyframe.value;
    };
    auto forgetful = std::make_shared<MapSnapshot>(*map);
    std::vector<std::shared_ptr<const Keyframe>> keyframes;
    map->keyframes.ForEach([&](const Keyframe& keyframe) {
      keyframes.resize(keyframe.id.value + 1);
      if (is_known(keyframe.id)) keyframes.back() = std::make_shared<Keyframe>(keyframe);
    });
    std::vector<std::shared_ptr<const Landmark>> landmarks;
    map->landmarks.ForEach([&](const Landmark& landmark) {
      Landmark known = landmark;
      std::erase_if(known.observations, [&](const auto& o) { return !is_known(o.keyframe); });
      landmarks.resize(landmark.id.value + 1);
      if (!known.observations.empty()) landmarks.back() = std::make_shared<Landmark>(known);
    });
    forgetful->keyframes = TableSnapshot<KeyframeId, Keyframe>(std::move(keyframes));
    forgetful->landmarks = TableSnapshot<LandmarkId, Landmark>(std::move(landmarks));
    return forgetful;
  }

  Slam& slam_;
  std::uint32_t memory_;
};

void PrintLoops(const RunOutcome& outcome, const Trajectory& truth) {
  const LoopCounts& counts = outcome.loop_counts;
  fmt::print("  {} closed; of {} similar {} inconsistent, {} few matches, {} no alignment, {} few "
             "inliers\n", counts.closed, counts.similar, counts.inconsistent, counts.few_matches,
             counts.no_alignment, counts.few_inliers);
  for (const LoopRecord& loop : outcome.loops) {
    fmt::print("  {:.2f} s shows {:.2f} s: {} matches, {} landmarks fused, drift {:.3f} m",
               1e-9 * static_cast<double>(loop.keyframe_stamp_ns - truth.front().stamp_ns),
               1e-9 * static_cast<double>(loop.place_stamp_ns - truth.front().stamp_ns),
               loop.matches, loop.landmarks_fused, loop.drift_m);
    const auto keyframe = InterpolatePose(truth, loop.keyframe_stamp_ns);
    const auto place = InterpolatePose(truth, loop.place_stamp_ns);
    if (keyframe && place) {
      const RigidTransform error =
          place->Inverse() * *keyframe * loop.place_from_keyframe.Inverse();
      fmt::print("; wrong by {:.3f} m, {:.2f} deg", error.translation().norm(),
                 error.RotationAngle() * 180 / M_PI);
    }
    fmt::print("\n");
  }
}

RunOutcome Run(const std::filesystem::path& folder, const PinholeCamera& camera,
               const SlamOptions& options, std::uint32_t memory) {
  const auto sequence = std::make_shared<const RgbdSequence>(folder, camera);
  PrefetchingSource source(std::make_unique<TumFrameSource>(sequence));
  Slam slam(camera, options, MakeSegmenter(options.perception, folder));
  ForgetfulBackEnd back_end(slam, memory);
  return RunSequential(slam, back_end, source, {});
}

int Main(int argc, char** argv) {
  if (argc < 4) throw Error("usage: ofm_measure_loop_closing SEQUENCE CAMERA MEMORY [option=value]");
  cv::setNumThreads(1);
  const std::filesystem::path folder = argv[1];
  const PinholeCamera camera = ResolveCamera(argv[2], folder);
  const auto memory = static_cast<std::uint32_t>(std::stoul(argv[3]));
  const Trajectory truth = LoadTrajectory(folder / "groundtruth.txt");
  SlamOptions options;
  options.build_semantic_map = false;
  for (int i = 4; i < argc; ++i) ApplyOptionAssignment(argv[i], OptionFields(options));
  for (const bool closing : {false, true}) {
    options.loop.enabled = closing;
    const RunOutcome outcome = Run(folder, camera, options, memory);
    fmt::print("loop closing {}: {} of {} frames, {} losses, {} keyframes, {} landmarks, ATE {:.2f} "
               "cm\n", closing ? "on" : "off", outcome.counts.frames_tracked,
               outcome.counts.frames, outcome.counts.losses, outcome.counts.keyframes,
               outcome.counts.landmarks,
               100 * EvaluateTrajectory(outcome.trajectory, truth).ate.translation_m.rmse);
    if (closing) PrintLoops(outcome, truth);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace ofm

int main(int argc, char** argv) {
  try {
    return ofm::Main(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
