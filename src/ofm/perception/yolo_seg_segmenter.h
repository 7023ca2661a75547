// Instances from a YOLO segmentation network (v5, v8, 11; the Ultralytics ONNX export).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ofm/perception/dnn_network.h"
#include "ofm/perception/segmenter.h"
#include "ofm/perception/yolo_decoder.h"

namespace ofm {

struct YoloSegModel {
  std::filesystem::path path;            ///< ONNX: 1 × 3 × H × W, RGB / 255
  std::vector<std::string> class_names;  ///< as many as the network tells apart
  cv::Size input;                        ///< empty = as the file says
};

class YoloSegSegmenter : public Segmenter {
 public:
  /// Loads the network. Throws Error that names the file where it cannot be used, be it for its
  /// outputs.
  YoloSegSegmenter(const YoloSegModel& model, const YoloDecoderOptions& options);

  /// `frame.color` may have any size. Throws Error where the network cannot be run.
  Segmentation Segment(const RgbdFrame& frame) override;
  const std::vector<std::string>& class_names() const override { return class_names_; }

 private:
  YoloOutputs Outputs() const;

  std::vector<std::string> class_names_;
  YoloDecoderOptions options_;
  DnnNetwork network_;
};

}  // namespace ofm
