// A value that one thread publishes and others read.
#pragma once

#include <utility>

#include "ofm/base/mutex.h"

namespace ofm {

/// The newest value of T, a cheap one to copy (a shared pointer). Any thread may call any method.
template <class T>
class Latest {
 public:
  void Set(T value) OFM_EXCLUDES(mutex_) {
    {
      MutexLock lock(mutex_);
      std::swap(value_, value);
    }
    changed_.notify_all();
  }

  T Get() const OFM_EXCLUDES(mutex_) {
    MutexLock lock(mutex_);
    return value_;
  }

  /// Waits until `accepts(value)`.
  template <class Accepts>
  void WaitUntil(Accepts&& accepts) const OFM_EXCLUDES(mutex_)
      OFM_THREAD_ANNOTATION(no_thread_safety_analysis) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&]() OFM_REQUIRES(mutex_) { return accepts(value_); });
  }

 private:
  mutable Mutex mutex_;
  mutable std::condition_variable_any changed_;
  T value_ OFM_GUARDED_BY(mutex_){};
};

}  // namespace ofm
