#include "ofm/pipeline/paced_source.h"

#include <time.h>

#include <utility>

#include "ofm/base/time.h"
#include "ofm/base/timing.h"

namespace ofm {

PacingClock SteadyPacingClock() {
  const auto wait = [](std::int64_t until_ns) {
    timespec until{};
    until.tv_sec = until_ns / kNanosecondsPerSecond;
    until.tv_nsec = until_ns % kNanosecondsPerSecond;
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
  };
  return {SteadyTimeNs, wait};
}

PacedSource::PacedSource(std::unique_ptr<FrameSource> source, PacingClock clock)
    : source_(std::move(source)), clock_(std::move(clock)) {}

std::optional<RgbdFrame> PacedSource::Next() {
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  std::optional<RgbdFrame> frame = ahead_ ? std::move(ahead_) : source_->Next();
  ahead_.reset();
  if (!frame) return {};
  if (!started_) {
    started_ = true;
    start_ns_ = clock_.now_ns();
    first_stamp_ns_ = frame->stamp_ns;
    return frame;
  }
  const std::int64_t now_ns = clock_.now_ns();
  if (DueNs(*frame) > now_ns) {
    clock_.wait_until_ns(DueNs(*frame));
    return frame;
  }
  // Late: skip to the newest frame that is due.
  while (ReadAhead() && DueNs(*ahead_) <= now_ns) {
    frame = std::move(ahead_);
    ++dropped_;
  }
  return frame;
}

bool PacedSource::ReadAhead() {
  try {
    ahead_ = source_->Next();
  } catch (const std::exception&) {
    ahead_.reset();
    error_ = std::current_exception();
  }
  return ahead_.has_value();
}

}  // namespace ofm
