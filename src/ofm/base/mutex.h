// Mutexes that clang's -Wthread-safety checks. Only base/ and map/ may hold one.
#pragma once

#include <condition_variable>
#include <mutex>

#if defined(__clang__)
#define OFM_THREAD_ANNOTATION(x) __attribute__((x))
#else
#define OFM_THREAD_ANNOTATION(x)
#endif

/// On a member: may be touched only while `mutex` is held.
#define OFM_GUARDED_BY(mutex) OFM_THREAD_ANNOTATION(guarded_by(mutex))
/// On a function: the caller holds the mutex.
#define OFM_REQUIRES(...) OFM_THREAD_ANNOTATION(requires_capability(__VA_ARGS__))
/// On a function: the caller must not hold the mutex.
#define OFM_EXCLUDES(...) OFM_THREAD_ANNOTATION(locks_excluded(__VA_ARGS__))

namespace ofm {

/// std::mutex with annotations.
class OFM_THREAD_ANNOTATION(capability("mutex")) Mutex {
 public:
  void Lock() OFM_THREAD_ANNOTATION(acquire_capability()) { mutex_.lock(); }
  void Unlock() OFM_THREAD_ANNOTATION(release_capability()) { mutex_.unlock(); }
  // The names that std::condition_variable_any wants.
  void lock() OFM_THREAD_ANNOTATION(acquire_capability()) { mutex_.lock(); }
  void unlock() OFM_THREAD_ANNOTATION(release_capability()) { mutex_.unlock(); }

 private:
  std::mutex mutex_;
};

/// Holds a Mutex for a scope.
class OFM_THREAD_ANNOTATION(scoped_lockable) MutexLock {
 public:
  explicit MutexLock(Mutex& mutex) OFM_THREAD_ANNOTATION(acquire_capability(mutex))
      : mutex_(mutex) {
    mutex_.Lock();
  }
  ~MutexLock() OFM_THREAD_ANNOTATION(release_capability()) { mutex_.Unlock(); }
  MutexLock(const MutexLock&) = delete;
  MutexLock& operator=(const MutexLock&) = delete;

 private:
  Mutex& mutex_;
};

}  // namespace ofm
