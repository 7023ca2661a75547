#include "ofm/perception/async_segmenter.h"

#include <stdexcept>
#include <utility>

#include "ofm/base/check.h"
#include "ofm/base/thread_priority.h"
#include "ofm/base/timing.h"

namespace ofm {

AsyncSegmenter::AsyncSegmenter(std::unique_ptr<Segmenter> segmenter, int niceness)
    : segmenter_(std::move(segmenter)) {
  OFM_CHECK(segmenter_ != nullptr && niceness >= 0);
  worker_ = std::jthread([this, niceness](std::stop_token stop) { Work(niceness, stop); });
}

AsyncSegmenter::~AsyncSegmenter() { worker_.request_stop(); }

void AsyncSegmenter::Submit(SegmentationRequest request) { requests_.Push(std::move(request)); }

std::optional<SegmentationAnswer> AsyncSegmenter::TakeAnswer() {
  if (const std::exception_ptr defect = defect_.Get()) std::rethrow_exception(defect);
  return answers_.TryPop();
}

void AsyncSegmenter::WaitForRuns(std::size_t runs) const {
  status_.WaitUntil([runs](const AsyncSegmenterStatus& status) { return status.runs >= runs; });
}

void AsyncSegmenter::Work(int niceness, std::stop_token stop) {
  LowerThreadPriority(niceness);
  AsyncSegmenterStatus status;
  while (std::optional<SegmentationRequest> request = requests_.Pop(stop)) {
    const std::int64_t start_ns = SteadyTimeNs();
    std::optional<Segmentation> segmentation = Run(request->frame, status);
    status.wall_ms += static_cast<double>(SteadyTimeNs() - start_ns) * 1e-6;
    ++status.runs;
    if (segmentation) {
      segmentation->frame_id = request->frame.id;
      answers_.Push({std::move(*request), std::move(*segmentation)});
    }
    status_.Set(status);
  }
}

std::optional<Segmentation> AsyncSegmenter::Run(const RgbdFrame& frame,
                                                AsyncSegmenterStatus& status) {
  try {
    return segmenter_->Segment(frame);
  } catch (const std::logic_error&) {
    defect_.Set(std::current_exception());
  } catch (const std::exception& error) {
    if (status.failures++ == 0) status.first_error = error.what();
  } catch (...) {
    if (status.failures++ == 0) status.first_error = "threw what is no std::exception";
  }
  return {};
}

}  // namespace ofm
