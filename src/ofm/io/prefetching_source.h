// Decodes frames ahead of their use.
#pragma once

#include <exception>
#include <memory>
#include <thread>
#include <variant>

#include "ofm/base/bounded_queue.h"
#include "ofm/io/frame_source.h"

namespace ofm {

/// Gives the frames of another source, which it reads in a thread of its own. Errors come in
/// order: the frames before one still come out, then Next() throws it once, then all is over. It
/// can be destroyed at any time.
class PrefetchingSource : public FrameSource {
 public:
  /// Up to `capacity` frames wait (3.2 MiB each at 640x480).
  explicit PrefetchingSource(std::unique_ptr<FrameSource> source, std::size_t capacity = 4);

  std::optional<RgbdFrame> Next() override;
  std::optional<std::size_t> size() const override { return size_; }

 private:
  using Item = std::variant<RgbdFrame, std::exception_ptr>;

  void ReadAll(std::stop_token stop);

  std::unique_ptr<FrameSource> source_;  // the thread's alone, once that runs
  std::optional<std::size_t> size_;
  BoundedQueue<Item> queue_;
  std::jthread thread_;  // last: it stops before what it uses goes
};

}  // namespace ofm
