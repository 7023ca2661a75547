// A segmenter that nobody waits for.
#pragma once

#include <cstddef>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "ofm/base/bounded_queue.h"
#include "ofm/base/latest.h"
#include "ofm/perception/segmenter.h"

namespace ofm {

/// A frame to be segmented. Copies share the images.
struct SegmentationRequest {
  RgbdFrame frame;
  std::size_t index = 0;  ///< the caller's count of frames
};

/// Instances with the request that they answer.
struct SegmentationAnswer {
  SegmentationRequest request;
  Segmentation segmentation;  ///< frame_id is the request's
};

/// What the worker has done so far.
struct AsyncSegmenterStatus {
  std::size_t runs = 0;      ///< of the network, failed ones too
  std::size_t failures = 0;  ///< that threw
  double wall_ms = 0;        ///< of all runs together
  std::string first_error;   ///< of the first that failed
};

/// Runs a segmenter in a thread of its own. One request at most waits: a newer one takes its place;
/// the one that is being worked on is never interrupted. At most three frames are held: one worked
/// on, one waiting, one answered. An exception of the segmenter is counted and its frame gets no
/// answer, but a std::logic_error is a programmer's and comes out of the next TakeAnswer. Submit
/// and TakeAnswer never wait; they serve one thread.
class AsyncSegmenter {
 public:
  /// The worker's thread is `niceness` (0 to 19) less urgent than the caller's, on Linux.
  AsyncSegmenter(std::unique_ptr<Segmenter> segmenter, int niceness);

  /// Waits for the run under way to end; what waits is dropped.
  ~AsyncSegmenter();
  AsyncSegmenter(const AsyncSegmenter&) = delete;
  AsyncSegmenter& operator=(const AsyncSegmenter&) = delete;

  void Submit(SegmentationRequest request);

  /// The newest answer not yet taken.
  std::optional<SegmentationAnswer> TakeAnswer();

  AsyncSegmenterStatus status() const { return status_.Get(); }

  /// Waits until `runs` runs have ended. For tests.
  void WaitForRuns(std::size_t runs) const;

  const std::vector<std::string>& class_names() const { return segmenter_->class_names(); }

 private:
  void Work(int niceness, std::stop_token stop);
  std::optional<Segmentation> Run(const RgbdFrame& frame, AsyncSegmenterStatus& status);

  std::unique_ptr<Segmenter> segmenter_;
  BoundedQueue<SegmentationRequest> requests_{1, OverflowPolicy::kLatestOnly};
  BoundedQueue<SegmentationAnswer> answers_{1, OverflowPolicy::kLatestOnly};
  Latest<AsyncSegmenterStatus> status_;
  Latest<std::exception_ptr> defect_;
  std::jthread worker_;  // last: ends before what it uses
};

}  // namespace ofm
