// The only way in which stages that run in different threads talk.
#pragma once

#include <deque>
#include <optional>
#include <stop_token>
#include <utility>

#include "ofm/base/check.h"
#include "ofm/base/mutex.h"

namespace ofm {

/// What a full queue does with a new value.
enum class OverflowPolicy {
  kBlock,       ///< the producer waits for room
  kDropOldest,  ///< the oldest value goes
  kLatestOnly,  ///< all older values go, whatever the capacity
};

/// A first-in, first-out queue of values between threads. All methods may be called from any
/// thread.
template <class T>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t capacity, OverflowPolicy policy = OverflowPolicy::kBlock)
      : capacity_(capacity), policy_(policy) {
    OFM_CHECK(capacity > 0);
  }

  /// False where the queue was closed or `stop` was requested before there was room; the value is
  /// then lost.
  bool Push(T value, std::stop_token stop = {}) OFM_EXCLUDES(mutex_)
      OFM_THREAD_ANNOTATION(no_thread_safety_analysis) {
    std::unique_lock lock(mutex_);
    if (!closed_) MakeRoom();
    const bool room =
        changed_.wait(lock, stop, [&]() OFM_REQUIRES(mutex_) { return closed_ || Fits(); });
    if (!room || closed_) return false;
    values_.push_back(std::move(value));
    lock.unlock();
    changed_.notify_all();
    return true;
  }

  /// Waits for a value; empty once the queue is closed and drained, or `stop` was requested.
  std::optional<T> Pop(std::stop_token stop = {}) OFM_EXCLUDES(mutex_)
      OFM_THREAD_ANNOTATION(no_thread_safety_analysis) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, stop, [&]() OFM_REQUIRES(mutex_) { return closed_ || !values_.empty(); });
    if (values_.empty() || stop.stop_requested()) return {};
    return TakeFront(lock);
  }

  /// Empty at once where nothing is waiting.
  std::optional<T> TryPop() OFM_EXCLUDES(mutex_) OFM_THREAD_ANNOTATION(no_thread_safety_analysis) {
    std::unique_lock lock(mutex_);
    if (values_.empty()) return {};
    return TakeFront(lock);
  }

  /// No more values come: waiting producers give up, consumers drain what is left.
  void Close() OFM_EXCLUDES(mutex_) {
    {
      MutexLock lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
  }

  std::size_t size() const OFM_EXCLUDES(mutex_) {
    MutexLock lock(mutex_);
    return values_.size();
  }

  /// Values that the overflow policy threw away so far.
  std::size_t dropped() const OFM_EXCLUDES(mutex_) {
    MutexLock lock(mutex_);
    return dropped_;
  }

 private:
  bool Fits() const OFM_REQUIRES(mutex_) { return values_.size() < capacity_; }

  void MakeRoom() OFM_REQUIRES(mutex_) {
    if (policy_ == OverflowPolicy::kBlock) return;
    const std::size_t keep = policy_ == OverflowPolicy::kLatestOnly ? 0 : capacity_ - 1;
    while (values_.size() > keep) {
      values_.pop_front();
      ++dropped_;
    }
  }

  std::optional<T> TakeFront(std::unique_lock<Mutex>& lock)
      OFM_THREAD_ANNOTATION(no_thread_safety_analysis) {
    std::optional<T> value(std::move(values_.front()));
    values_.pop_front();
    lock.unlock();
    changed_.notify_all();
    return value;
  }

  const std::size_t capacity_;
  const OverflowPolicy policy_;
  mutable Mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<T> values_ OFM_GUARDED_BY(mutex_);
  std::size_t dropped_ OFM_GUARDED_BY(mutex_) = 0;
  bool closed_ OFM_GUARDED_BY(mutex_) = false;
};

}  // namespace ofm
