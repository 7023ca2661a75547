#include "interrupt.h"

#include <pthread.h>

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <thread>

namespace ofm {
namespace {

constexpr int kExitInterrupted = 128 + SIGINT;

sigset_t InterruptSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

}  // namespace

/// Waits for the signals in a thread: a handler could not request a stop safely.
struct InterruptStop::Watcher {
  explicit Watcher(std::stop_source& source)
      : thread([&source](const std::stop_token& end) {
          const sigset_t signals = InterruptSignals();
          const timespec poll{0, 50'000'000};
          while (!end.stop_requested()) {
            if (sigtimedwait(&signals, nullptr, &poll) < 0) continue;
            if (source.stop_requested()) std::_Exit(kExitInterrupted);
            source.request_stop();
          }
        }) {}

  std::jthread thread;
};

InterruptStop::InterruptStop() {
  // Blocked here, and so in all threads started from now on; the watcher takes them.
  const sigset_t signals = InterruptSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  watcher_ = std::make_unique<Watcher>(source_);
}

InterruptStop::~InterruptStop() {
  watcher_.reset();
  const sigset_t signals = InterruptSignals();
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

}  // namespace ofm
