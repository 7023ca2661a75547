// Instances from a Mask R-CNN.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ofm/perception/mask_rcnn_decoder.h"
#include "ofm/perception/mask_rcnn_network.h"
#include "ofm/perception/segmenter.h"

namespace ofm {

class MaskRcnnSegmenter : public Segmenter {
 public:
  /// `class_names`: empty = COCO's 80. Throws Error where they do not fit the network.
  MaskRcnnSegmenter(std::unique_ptr<MaskRcnnNetwork> network, std::vector<std::string> class_names,
                    const MaskRcnnDecoderOptions& options);

  /// `frame.color` may have any size. Throws Error where the network cannot be run.
  Segmentation Segment(const RgbdFrame& frame) override;
  const std::vector<std::string>& class_names() const override { return class_names_; }

 private:
  std::unique_ptr<MaskRcnnNetwork> network_;
  std::vector<std::string> class_names_;
  ClassMap classes_;
  MaskRcnnDecoderOptions options_;
};

}  // namespace ofm
