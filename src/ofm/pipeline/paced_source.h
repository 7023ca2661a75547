// Plays a recording as fast as it was recorded.
#pragma once

#include <exception>
#include <functional>
#include <memory>

#include "ofm/io/frame_source.h"

namespace ofm {

/// A clock that can wait: real time, or a made one in tests. Times in nanoseconds.
struct PacingClock {
  std::function<std::int64_t()> now_ns;
  std::function<void(std::int64_t)> wait_until_ns;
};

/// The machine's steady clock.
PacingClock SteadyPacingClock();

/// Gives each frame when it is due; of several that are due by the time it is asked, only the
/// latest, as a camera would: the others are dropped and counted. The first frame is due when it is
/// first asked for.
class PacedSource : public FrameSource {
 public:
  PacedSource(std::unique_ptr<FrameSource> source, PacingClock clock);

  std::optional<RgbdFrame> Next() override;
  std::optional<std::size_t> size() const override { return source_->size(); }
  std::size_t dropped() const { return dropped_; }

 private:
  std::int64_t DueNs(const RgbdFrame& frame) const {
    return start_ns_ + frame.stamp_ns - first_stamp_ns_;
  }

  /// False at the end, and where the source fails: the frame before it is to be given first.
  bool ReadAhead();

  std::unique_ptr<FrameSource> source_;
  PacingClock clock_;
  std::optional<RgbdFrame> ahead_;  // read, not yet due when it was
  std::exception_ptr error_;        // met while reading ahead, thrown by the next Next()
  bool started_ = false;
  std::int64_t start_ns_ = 0, first_stamp_ns_ = 0;
  std::size_t dropped_ = 0;
};

}  // namespace ofm
