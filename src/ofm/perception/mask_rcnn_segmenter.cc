#include "ofm/perception/mask_rcnn_segmenter.h"

#include <utility>

#include "ofm/base/check.h"
#include "ofm/perception/class_names.h"

namespace ofm {

MaskRcnnSegmenter::MaskRcnnSegmenter(std::unique_ptr<MaskRcnnNetwork> network,
                                     std::vector<std::string> class_names,
                                     const MaskRcnnDecoderOptions& options)
    : network_(std::move(network)), class_names_(std::move(class_names)), options_(options) {
  OFM_CHECK(network_ != nullptr);
  if (class_names_.empty()) {
    classes_ = network_->MapToCoco();
    class_names_ = CocoClassNames();
  } else {
    classes_ = network_->MapToNames(static_cast<int>(class_names_.size()));
  }
}

Segmentation MaskRcnnSegmenter::Segment(const RgbdFrame& frame) {
  OFM_CHECK(frame.color.type() == CV_8UC3);
  const Letterbox letterbox = network_->Fit(frame.color.size());
  return {frame.id,
          DecodeMaskRcnn(network_->Detect(frame.color, letterbox), letterbox, classes_, options_)};
}

}  // namespace ofm
