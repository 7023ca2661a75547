// A segmenter whose runs a test lets happen. Tests only.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ofm/base/bounded_queue.h"
#include "ofm/perception/segmenter.h"

namespace ofm::test {

/// A counting semaphore. GCC 12's std::counting_semaphore can sleep for ever (GCC bug 104928).
class Signal {
 public:
  void release(int count = 1) {
    for (int i = 0; i < count; ++i) given_.Push(0);
  }
  void acquire() { given_.Pop(); }

 private:
  BoundedQueue<char> given_{1000};
};

/// What the segmenter in another thread and the test share.
struct Gate {
  Signal started;  ///< one for each run that began
  Signal allowed;  ///< one for each run that may end
};

/// Calls a function on each frame; with a gate, when the test allows.
class ScriptedSegmenter : public Segmenter {
 public:
  explicit ScriptedSegmenter(std::function<Segmentation(const RgbdFrame&)> script,
                             Gate* gate = nullptr)
      : script_(std::move(script)), gate_(gate) {}

  Segmentation Segment(const RgbdFrame& frame) override {
    if (gate_ != nullptr) {
      gate_->started.release();
      gate_->allowed.acquire();
    }
    return script_(frame);
  }
  const std::vector<std::string>& class_names() const override { return class_names_; }

 private:
  std::function<Segmentation(const RgbdFrame&)> script_;
  Gate* gate_;
  std::vector<std::string> class_names_ = {"person"};
};

}  // namespace ofm::test
