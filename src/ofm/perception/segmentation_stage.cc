#include "ofm/perception/segmentation_stage.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "ofm/base/check.h"
#include "ofm/base/time.h"
#include "ofm/base/timing.h"

namespace ofm {

SegmentationStage::SegmentationStage(std::unique_ptr<Segmenter> segmenter,
                                     const SegmentationScheduleOptions& options,
                                     const OpticalFlowOptions& flow)
    : options_(options), flow_(flow) {
  OFM_CHECK(segmenter != nullptr && options.every_nth > 0 && options.max_steps > 0);
  if (options.mode == SegmentationMode::kLatest) {
    async_ = std::make_unique<AsyncSegmenter>(std::move(segmenter), options.niceness);
  } else {
    segmenter_ = std::move(segmenter);
  }
}

bool SegmentationStage::NeedsPyramid() const {
  return async_ != nullptr || options_.every_nth > 1 ||
         options_.on_failure == SegmentationFailure::kContinue;
}

const std::vector<std::string>& SegmentationStage::class_names() const {
  return async_ ? async_->class_names() : segmenter_->class_names();
}

Segmentation SegmentationStage::Process(const RgbdFrame& frame, const FlowPyramid& pyramid) {
  OFM_CHECK(!NeedsPyramid() || pyramid.size == frame.gray.size());
  const Moment now{statistics_.frames++, {pyramid, frame.depth_m, frame.stamp_ns}};
  if (async_) {
    async_->Submit({frame, pyramid, now.index});
    TakeAnswer();
  } else if (now.index % static_cast<std::size_t>(options_.every_nth) == 0) {
    RunNetwork(frame, now);
  }
  DropIfTooOld(now);
  if (NeedsPyramid()) CarryTo(now);
  if (async_) {
    history_.push_back(now);
    if (history_.size() > static_cast<std::size_t>(options_.history)) history_.pop_front();
  }
  return Current(frame.id, now);
}

void SegmentationStage::RunNetwork(const RgbdFrame& frame, const Moment& now) {
  const std::int64_t start_ns = SteadyTimeNs();
  ++statistics_.network_runs;
  try {
    Segmentation segmentation = segmenter_->Segment(frame);
    instances_.clear();
    for (Instance& instance : segmentation.instances) instances_.push_back({std::move(instance)});
    source_ = at_ = now;
  } catch (const std::logic_error&) {
    throw;
  } catch (const std::exception& error) {
    if (options_.on_failure == SegmentationFailure::kStop) throw;
    if (statistics_.failures++ == 0) ReportFailure(error.what());
  }
  statistics_.network_ms += static_cast<double>(SteadyTimeNs() - start_ns) * 1e-6;
}

void SegmentationStage::ReportFailure(const std::string& error) {
  statistics_.first_error = error;
  spdlog::warn("the network failed on a frame, masks are carried on: {}", error);
}

void SegmentationStage::TakeAnswer() {
  const std::optional<SegmentationAnswer> answer = async_->TakeAnswer();
  if (statistics_.first_error.empty()) {
    const AsyncSegmenterStatus status = async_->status();
    if (status.failures > 0) ReportFailure(status.first_error);
  }
  if (!answer) return;
  const SegmentationRequest& request = answer->request;
  source_ = at_ = {request.index, {request.pyramid, request.frame.depth_m, request.frame.stamp_ns}};
  instances_.clear();
  for (const Instance& instance : answer->segmentation.instances) instances_.push_back({instance});
  // Through the frames since then, or some of them, evenly chosen; the last step is Process's.
  std::vector<const Moment*> later;
  for (const Moment& moment : history_) {
    if (moment.index > request.index) later.push_back(&moment);
  }
  const auto steps = std::min(later.size(), static_cast<std::size_t>(options_.max_steps) - 1);
  for (std::size_t k = 1; k <= steps; ++k) CarryTo(*later[k * later.size() / steps - 1]);
}

void SegmentationStage::CarryTo(const Moment& now) {
  if (source_ && at_.index != now.index) {
    instances_ = CarryInstances(instances_, at_.frame, now.frame, options_.propagation, flow_);
  }
  at_ = now;
}

void SegmentationStage::DropIfTooOld(const Moment& now) {
  if (!source_) return;
  const std::int64_t age_ns = now.frame.stamp_ns - source_->frame.stamp_ns;
  if (NanosecondsToSeconds(age_ns) <= options_.max_age_s) return;
  ++statistics_.expiries;
  source_.reset();
  instances_.clear();
}

Segmentation SegmentationStage::Current(FrameId id, const Moment& now) {
  Segmentation segmentation;
  segmentation.frame_id = id;
  for (const CarriedInstance& carried : instances_) {
    segmentation.instances.push_back(carried.instance);
  }
  segmentation.age_frames.reset();
  if (source_) {
    const std::size_t age = now.index - source_->index;
    segmentation.age_frames = static_cast<int>(age);
    age_sum_frames_ += static_cast<double>(age);
  } else {
    ++statistics_.frames_without;
  }
  return segmentation;
}

SegmentationStatistics SegmentationStage::statistics() const {
  SegmentationStatistics statistics = statistics_;
  if (async_) {
    const AsyncSegmenterStatus status = async_->status();
    statistics.network_runs = status.runs;
    statistics.failures = status.failures;
    statistics.network_ms = status.wall_ms;
  }
  const std::size_t with = statistics.frames - statistics.frames_without;
  if (with > 0) statistics.mean_age_frames = age_sum_frames_ / static_cast<double>(with);
  return statistics;
}

}  // namespace ofm
