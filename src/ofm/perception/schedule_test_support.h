// A segmenter whose runs a test lets happen. Tests only.
#pragma once

#include <functional>
#include <memory>
#include <semaphore>
#include <string>
#include <vector>

#include "ofm/perception/segmenter.h"

namespace ofm::test {

/// What the segmenter in another thread and the test share.
struct Gate {
  std::counting_semaphore<1000> started{0};  ///< one for each run that began
  std::counting_semaphore<1000> allowed{0};  ///< one for each run that may end
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
