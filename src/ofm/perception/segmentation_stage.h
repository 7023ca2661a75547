// Instances for every frame, whether or not the network has run on it.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ofm/perception/async_segmenter.h"
#include "ofm/perception/flow_frame.h"
#include "ofm/perception/segmentation_schedule.h"

namespace ofm {

struct SegmentationStatistics {
  std::size_t frames = 0;
  std::size_t network_runs = 0;    ///< failed ones too
  std::size_t failures = 0;        ///< runs that threw
  std::size_t frames_without = 0;  ///< frames before the first masks, or after they were dropped
  std::size_t expiries = 0;        ///< times that masks were dropped, as they were too old
  double mean_age_frames = 0;      ///< of the masks, over the frames that had some to go by
  double network_ms = 0;           ///< wall time of the network in all
  std::string first_error;         ///< of the first run that failed
};

/// Runs a segmenter by a schedule and carries masks to the frames that it did not run on. Mode
/// `wait` with every_nth = 1 gives what the segmenter gives. Serves one thread.
class SegmentationStage {
 public:
  /// `flow` must be what the pyramids are made with.
  SegmentationStage(std::unique_ptr<Segmenter> segmenter,
                    const SegmentationScheduleOptions& options, const OpticalFlowOptions& flow);

  /// The instances in `frame`, with their age. Frames come in increasing order of time; `pyramid`
  /// is of frame.gray and may be empty where NeedsPyramid() is false. Mode `wait`: throws what the
  /// segmenter throws, unless told to continue. Mode `latest`: never waits, and throws only a
  /// programmer's error.
  Segmentation Process(const RgbdFrame& frame, const FlowPyramid& pyramid);

  bool NeedsPyramid() const;
  const std::vector<std::string>& class_names() const;
  SegmentationStatistics statistics() const;

 private:
  /// A frame and its number.
  struct Moment {
    std::size_t index = 0;
    FlowFrame frame;
  };

  void RunNetwork(const RgbdFrame& frame, const Moment& now);
  void TakeAnswer();
  void CarryTo(const Moment& now);
  void DropIfTooOld(const Moment& now);
  void ReportFailure(const std::string& error);
  Segmentation Current(FrameId id, const Moment& now);

  SegmentationScheduleOptions options_;
  OpticalFlowOptions flow_;
  std::unique_ptr<Segmenter> segmenter_;    // mode wait
  std::unique_ptr<AsyncSegmenter> async_;   // mode latest
  std::vector<CarriedInstance> instances_;  // as they are in at_
  Moment at_;                               // of what is kept, the frame that instances_ are of
  std::optional<Moment> source_;            // where the network saw them; empty = nothing to go by
  std::deque<Moment> history_;              // mode latest: the frames before, the newest last
  SegmentationStatistics statistics_;
  double age_sum_frames_ = 0;
};

}  // namespace ofm
