// Plays a recording as fast as it was recorded.
#pragma once

#include <cstddef>
#include <deque>
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

/// Gives each frame when it is due. Frames that are due before they are asked for wait in a queue,
/// as in a camera's driver: one slow frame loses nothing. Of more than it holds the oldest are
/// dropped and counted, so that no frame comes later than the queue is long. The first frame is due
/// when it is first asked for.
class PacedSource : public FrameSource {
 public:
  /// `queue_frames` > 0; with 1 only the newest frame waits.
  PacedSource(std::unique_ptr<FrameSource> source, PacingClock clock, std::size_t queue_frames);

  std::optional<RgbdFrame> Next() override;
  std::optional<std::size_t> size() const override { return source_->size(); }
  std::size_t dropped() const { return dropped_; }

  /// When a frame of that stamp is due, by the clock; known once a frame was given.
  std::int64_t DueNs(std::int64_t stamp_ns) const { return start_ns_ + stamp_ns - first_stamp_ns_; }

 private:
  /// Reads what is due by now into the queue, and one frame more.
  void ReadDue(std::int64_t now_ns);
  /// False at the end, and where the source fails: the frames before it are to be given first.
  bool ReadAhead();
  void ThrowError();

  std::unique_ptr<FrameSource> source_;
  PacingClock clock_;
  std::size_t queue_frames_;
  std::deque<RgbdFrame> queue_;     // due, the oldest first
  std::optional<RgbdFrame> ahead_;  // read, not yet due when it was
  std::exception_ptr error_;        // met while reading ahead, thrown once the queue is empty
  bool ended_ = false;              // nothing more is to be read
  bool started_ = false;
  std::int64_t start_ns_ = 0, first_stamp_ns_ = 0;
  std::size_t dropped_ = 0;
};

}  // namespace ofm
