#include "ofm/pipeline/paced_source.h"

#include <time.h>

#include <utility>

#include "ofm/base/check.h"
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

PacedSource::PacedSource(std::unique_ptr<FrameSource> source, PacingClock clock,
                         std::size_t queue_frames)
    : source_(std::move(source)), clock_(std::move(clock)), queue_frames_(queue_frames) {
  OFM_CHECK(queue_frames > 0);
}

std::optional<RgbdFrame> PacedSource::Next() {
  if (!started_) {
    if (!ReadAhead()) ThrowError();
    if (!ahead_) return {};
    started_ = true;
    start_ns_ = clock_.now_ns();
    first_stamp_ns_ = ahead_->stamp_ns;
    return std::exchange(ahead_, std::nullopt);
  }
  ReadDue(clock_.now_ns());
  if (!queue_.empty()) {
    RgbdFrame frame = std::move(queue_.front());
    queue_.pop_front();
    return frame;
  }
  if (!ahead_) ThrowError();
  if (!ahead_) return {};
  clock_.wait_until_ns(DueNs(ahead_->stamp_ns));
  return std::exchange(ahead_, std::nullopt);
}

void PacedSource::ReadDue(std::int64_t now_ns) {
  while ((ahead_ || ReadAhead()) && DueNs(ahead_->stamp_ns) <= now_ns) {
    queue_.push_back(std::move(*ahead_));
    ahead_.reset();
    if (queue_.size() <= queue_frames_) continue;
    queue_.pop_front();
    ++dropped_;
  }
}

bool PacedSource::ReadAhead() {
  if (ended_) return false;
  try {
    ahead_ = source_->Next();
  } catch (const std::exception&) {
    error_ = std::current_exception();
  }
  ended_ = !ahead_;
  return !ended_;
}

void PacedSource::ThrowError() {
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

}  // namespace ofm
