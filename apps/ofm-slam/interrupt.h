// Ctrl-C as a stop token.
#pragma once

#include <memory>
#include <stop_token>

namespace ofm {

/// While it lives, SIGINT and SIGTERM request a stop instead of ending the process; a second one
/// ends it.
class InterruptStop {
 public:
  InterruptStop();
  ~InterruptStop();
  InterruptStop(const InterruptStop&) = delete;
  InterruptStop& operator=(const InterruptStop&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  struct Watcher;
  std::unique_ptr<Watcher> watcher_;
};

}  // namespace ofm
