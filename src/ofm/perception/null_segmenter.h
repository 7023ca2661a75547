// The segmenter that sees nothing.
#pragma once

#include <string>
#include <vector>

#include "ofm/perception/segmenter.h"

namespace ofm {

/// Finds no instance in any frame and knows no class.
class NullSegmenter : public Segmenter {
 public:
  Segmentation Segment(const RgbdFrame& frame) override { return {frame.id, {}}; }
  const std::vector<std::string>& class_names() const override { return class_names_; }

 private:
  std::vector<std::string> class_names_;
};

}  // namespace ofm
