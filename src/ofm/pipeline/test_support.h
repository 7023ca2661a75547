// A small simulated recording and quick settings. Tests only.
#pragma once

#include <functional>
#include <memory>
#include <new>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "ofm/base/error.h"
#include "ofm/map/submap.h"
#include "ofm/pipeline/back_end.h"
#include "ofm/pipeline/runner.h"
#include "ofm/sim/sim_sequence.h"

namespace ofm::test {

/// A walk through a room with one person close to the camera.
inline SimSequenceOptions SmallSequence(int frames) {
  SimSequenceOptions options;
  options.frames = frames;
  options.rate_hz = 15;
  options.camera = MakeSimCamera(240, 180);
  options.room.people = 1;
  return options;
}

/// Few features and coarse voxels.
inline SlamOptions QuickOptions() {
  SlamOptions options;
  options.features.count = 500;
  options.dense.resolution_m = 0.1;
  return options;
}

/// Frames rendered once, played as often as wanted.
struct Recording {
  explicit Recording(int frames, std::uint64_t seed = 1, int people = 1)
      : sequence(Options(frames, seed, people)) {
    while (auto frame = sequence.Next()) images.push_back(std::move(*frame));
  }

  SimSequence sequence;
  std::vector<RgbdFrame> images;

 private:
  static SimSequenceOptions Options(int frames, std::uint64_t seed, int people) {
    SimSequenceOptions options = SmallSequence(frames);
    options.seed = seed;
    options.room.people = people;
    return options;
  }
};

/// Plays frames; calls `before` with the index of each frame, which may throw, and at the end.
class PlaySource : public FrameSource {
 public:
  explicit PlaySource(std::vector<RgbdFrame> frames, std::function<void(std::size_t)> before = {})
      : frames_(std::move(frames)), before_(std::move(before)) {}

  std::optional<RgbdFrame> Next() override {
    if (before_) before_(next_);
    if (next_ == frames_.size()) return {};
    return frames_[next_++];
  }
  std::optional<std::size_t> size() const override { return frames_.size(); }

 private:
  std::vector<RgbdFrame> frames_;
  std::function<void(std::size_t)> before_;
  std::size_t next_ = 0;
};

/// Knows the movers from the simulation.
class TruthSegmenter : public Segmenter {
 public:
  explicit TruthSegmenter(const SimSequence& sequence) : sequence_(sequence) {}

  Segmentation Segment(const RgbdFrame& frame) override {
    Segmentation segmentation{frame.id, {}};
    const cv::Mat movers = sequence_.MoverMask(frame.id);
    for (std::uint32_t id = 1; id <= sequence_.scene().mover_count(); ++id) {
      const cv::Mat mask = movers == static_cast<int>(id);
      const cv::Rect box = cv::boundingRect(mask);
      if (!box.empty()) {
        segmentation.instances.push_back({InstanceId(id), ClassId(0), 1.0F, box, mask});
      }
    }
    return segmentation;
  }
  const std::vector<std::string>& class_names() const override { return class_names_; }

 private:
  const SimSequence& sequence_;
  std::vector<std::string> class_names_ = {"person"};
};

/// A system for the recording, which must outlive it.
inline std::unique_ptr<Slam> MakeSlam(const Recording& recording,
                                      const SlamOptions& options = QuickOptions()) {
  return std::make_unique<Slam>(recording.sequence.camera(), options,
                                std::make_unique<TruthSegmenter>(recording.sequence));
}

/// Options under which every other frame becomes a keyframe.
inline SlamOptions KeyframesOften() {
  SlamOptions options = QuickOptions();
  options.tracking.keyframe.max_frames = 2;
  return options;
}

inline void RunOutOfMemory() { throw std::bad_alloc(); }

enum class BackEndStep { kInsert, kRefine, kFinish };

/// Fails the n-th time that it comes to a step, by an exception that `fail` throws.
class FailingBackEnd : public BackEnd {
 public:
  FailingBackEnd(Slam& slam, BackEndStep step, int time, std::function<void()> fail)
      : BackEnd(slam), slam_(slam), step_(step), left_(time), fail_(std::move(fail)) {}

  std::shared_ptr<const MapSnapshot> Insert(KeyframeJob job) override {
    ComeTo(BackEndStep::kInsert);
    return BackEnd::Insert(std::move(job));
  }
  std::shared_ptr<const MapSnapshot> Refine(std::stop_token stop) override {
    ComeTo(BackEndStep::kRefine);
    return BackEnd::Refine(stop);
  }
  void Finish(RunOutcome& outcome) override {
    outcome.map = slam_.mapper().Snapshot();
    outcome.submap = LargestSubmap(*outcome.map);
    ComeTo(BackEndStep::kFinish);
    BackEnd::Finish(outcome);
  }

 private:
  void ComeTo(BackEndStep step) {
    if (step == step_ && --left_ == 0) fail_();
  }

  Slam& slam_;
  BackEndStep step_;
  int left_;
  std::function<void()> fail_;
};

/// Calls a function for each frame.
class CallingObserver : public RunObserver {
 public:
  explicit CallingObserver(std::function<void(const FrameReport&)> call) : call_(std::move(call)) {}
  void OnFrame(const FrameReport& report) override { call_(report); }

 private:
  std::function<void(const FrameReport&)> call_;
};

}  // namespace ofm::test
