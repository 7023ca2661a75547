// Mask R-CNN exported to ONNX with boxes, labels, scores and masks as outputs, run by ONNX Runtime:
// torchvision's exports, and MaskRCNN-10 and -12 of the ONNX model zoo.
#pragma once

#include <filesystem>

#include "ofm/perception/mask_rcnn_input.h"
#include "ofm/perception/mask_rcnn_network.h"
#include "ofm/perception/mask_rcnn_outputs.h"
#include "ofm/perception/onnx_runtime_network.h"

namespace ofm {

class OnnxMaskRcnn : public MaskRcnnNetwork {
 public:
  /// Loads the network and runs it once on an empty image, which tells who exported it. `input`
  /// goes before the size that the exporter's networks want and must be the file's where that fixes
  /// one; empty = as the network wants it. Throws Error that names the file where it cannot be
  /// used, or in a build without ONNX Runtime.
  OnnxMaskRcnn(const std::filesystem::path& path, cv::Size input);

  MaskRcnnExport exporter() const { return exporter_; }

  Letterbox Fit(cv::Size image) const override;
  std::vector<MaskRcnnDetection> Detect(const cv::Mat& image, const Letterbox& letterbox) override;
  ClassMap MapToCoco() const override;
  ClassMap MapToNames(int class_count) const override;

 private:
  OnnxMaskRcnnOutputs Run(const cv::Mat& blob);

  OnnxRuntimeNetwork network_;
  cv::Size input_;  // fixed; empty where the network takes any
  MaskRcnnExport exporter_ = MaskRcnnExport::kTorchvision;
};

}  // namespace ofm
