#include "ofm/perception/yolo_seg_segmenter.h"

#include "ofm/base/check.h"
#include "ofm/base/error.h"
#include "ofm/perception/letterbox.h"

namespace ofm {

YoloSegSegmenter::YoloSegSegmenter(const YoloSegModel& model, const YoloDecoderOptions& options)
    : class_names_(model.class_names), options_(options), network_(model.path, model.input) {
  Outputs();  // those of the trial run: a network of another layout is refused here
}

Segmentation YoloSegSegmenter::Segment(const RgbdFrame& frame) {
  OFM_CHECK(frame.color.type() == CV_8UC3);
  const Letterbox letterbox = MakeLetterbox(frame.color.size(), network_.input_size());
  network_.Run(ApplyLetterbox(letterbox, frame.color));
  return {frame.id, DecodeYolo(Outputs(), letterbox, options_)};
}

YoloOutputs YoloSegSegmenter::Outputs() const {
  try {
    return SelectYoloOutputs(network_.outputs(), static_cast<int>(class_names_.size()));
  } catch (const Error& error) {
    throw Error(network_.path(), error.what());
  }
}

}  // namespace ofm
