// Instances for every frame, whether or not the network has run on it.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ofm/perception/async_segmenter.h"
#include "ofm/perception/lattice_flow.h"
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
  /// `cells` are those of the steps.
  SegmentationStage(std::unique_ptr<Segmenter> segmenter,
                    const SegmentationScheduleOptions& options, const IdealLattice& cells);

  /// The instances in `frame`, with their age. `step` is that of the frame and may be empty where
  /// NeedsFlow() is false. Masks are dropped where it has no flow, as at a jump back in time. Mode
  /// `wait`: throws what the segmenter throws, unless told to continue. Mode `latest`: never waits,
  /// and throws only a programmer's error.
  Segmentation Process(const RgbdFrame& frame, const LatticeStep& step);

  bool NeedsFlow() const;
  const std::vector<std::string>& class_names() const;
  SegmentationStatistics statistics() const;

 private:
  /// A frame's number, time, and way from the frame before.
  struct Moment {
    std::size_t index = 0;
    std::int64_t stamp_ns = 0;
    LatticeStep step;
  };
  /// What the network saw last.
  struct Source {
    std::size_t index = 0;
    std::int64_t stamp_ns = 0;
    MaskSource masks;
  };

  void RunNetwork(const RgbdFrame& frame);
  void TakeAnswer();
  void SetSource(const Moment& moment, std::vector<Instance> instances);
  void CarryTo(const Moment& moment);
  void DropIfTooOld();
  void ReportFailure(const std::string& error);
  Segmentation Current(const RgbdFrame& frame);

  SegmentationScheduleOptions options_;
  MaskPropagation propagation_;
  std::unique_ptr<Segmenter> segmenter_;   // mode wait
  std::unique_ptr<AsyncSegmenter> async_;  // mode latest
  std::optional<Source> source_;           // empty = nothing to go by
  cv::Mat origins_;                        // of the newest frame's cells in the source's frame
  /// The newest frame last. Before it, mode latest: those younger than the source, of which an
  /// answer may come; mode wait: the one before.
  std::deque<Moment> moments_;
  SegmentationStatistics statistics_;
  double age_sum_frames_ = 0;
};

}  // namespace ofm
