#include "ofm/perception/segmentation_stage.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "ofm/base/check.h"
#include "ofm/base/time.h"
#include "ofm/base/timing.h"
#include "ofm/perception/cell_origins.h"

namespace ofm {

SegmentationStage::SegmentationStage(std::unique_ptr<Segmenter> segmenter,
                                     const SegmentationScheduleOptions& options,
                                     const IdealLattice& cells)
    : options_(options), propagation_(cells, options.propagation) {
  OFM_CHECK(segmenter != nullptr && options.every_nth > 0);
  if (options.mode == SegmentationMode::kLatest) {
    async_ = std::make_unique<AsyncSegmenter>(std::move(segmenter), options.niceness);
  } else {
    segmenter_ = std::move(segmenter);
  }
}

bool SegmentationStage::NeedsFlow() const {
  return async_ != nullptr || options_.every_nth > 1 ||
         options_.on_failure == SegmentationFailure::kContinue;
}

const std::vector<std::string>& SegmentationStage::class_names() const {
  return async_ ? async_->class_names() : segmenter_->class_names();
}

Segmentation SegmentationStage::Process(const RgbdFrame& frame, const LatticeStep& step) {
  OFM_CHECK(!NeedsFlow() || !step.frame.depth_m.empty());
  moments_.push_back({statistics_.frames++, frame.stamp_ns, step});
  if (source_ && NeedsFlow()) CarryTo(moments_.back());
  if (async_) {
    async_->Submit({frame, moments_.back().index});
    TakeAnswer();
  } else if (moments_.back().index % static_cast<std::size_t>(options_.every_nth) == 0) {
    RunNetwork(frame);
  }
  DropIfTooOld();
  return Current(frame);
}

void SegmentationStage::RunNetwork(const RgbdFrame& frame) {
  const std::int64_t start_ns = SteadyTimeNs();
  ++statistics_.network_runs;
  try {
    SetSource(moments_.back(), segmenter_->Segment(frame).instances);
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
  const std::size_t index = answer->request.index;
  if (index < moments_.front().index) return;  // too old
  auto moment = moments_.begin() + static_cast<std::ptrdiff_t>(index - moments_.front().index);
  SetSource(*moment, answer->segmentation.instances);
  while (source_ && ++moment != moments_.end()) CarryTo(*moment);
}

void SegmentationStage::SetSource(const Moment& moment, std::vector<Instance> instances) {
  source_ = Source{moment.index, moment.stamp_ns, {}};
  if (!NeedsFlow()) {
    source_->masks.instances = std::move(instances);
    return;
  }
  source_->masks = propagation_.Prepare(std::move(instances), moment.step.frame.depth_m);
  origins_ = OwnOrigins(moment.step.frame.depth_m.size());
}

/// One frame on from where origins_ are.
void SegmentationStage::CarryTo(const Moment& moment) {
  if (moment.step.flow.empty()) {
    source_.reset();
    return;
  }
  const auto before = static_cast<std::ptrdiff_t>(moment.index - moments_.front().index) - 1;
  origins_ = CarryOrigins(origins_, (moments_.begin() + before)->step.frame.depth_m, moment.step);
}

/// The masks, and the frames that are no longer needed.
void SegmentationStage::DropIfTooOld() {
  const Moment& now = moments_.back();
  const auto is_too_old = [&](std::int64_t stamp_ns) {
    return NanosecondsToSeconds(now.stamp_ns - stamp_ns) > options_.max_age_s;
  };
  if (source_ && is_too_old(source_->stamp_ns)) {
    ++statistics_.expiries;
    source_.reset();
  }
  const std::size_t oldest = async_ ? (source_ ? source_->index : 0) : now.index;
  while (moments_.size() > 1 &&
         (moments_.front().index < oldest || is_too_old(moments_.front().stamp_ns))) {
    moments_.pop_front();
  }
}

Segmentation SegmentationStage::Current(const RgbdFrame& frame) {
  const Moment& now = moments_.back();
  Segmentation segmentation;
  segmentation.frame_id = frame.id;
  segmentation.age_frames.reset();
  if (!source_) {
    ++statistics_.frames_without;
    return segmentation;
  }
  const std::size_t age = now.index - source_->index;
  segmentation.age_frames = static_cast<int>(age);
  age_sum_frames_ += static_cast<double>(age);
  segmentation.instances =
      age == 0 ? source_->masks.instances
               : propagation_.Carry(source_->masks,
                                    {origins_, now.step.frame.depth_m, frame.depth_m,
                                     NanosecondsToSeconds(now.stamp_ns - source_->stamp_ns)});
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
