// The output tensors of the exports of Mask R-CNN, told apart and read.
#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "ofm/perception/mask_rcnn_decoder.h"
#include "ofm/perception/onnx_runtime_network.h"

namespace ofm {

/// A graph of TensorFlow's object detection API as OpenCV runs it. `detections`, 1 × 1 × N × 7:
/// image, class (from 0, without the background), score, left, top, right and bottom as shares of
/// the input. `masks`, N × classes × height × width: probabilities in the box.
struct TensorflowMaskRcnnOutputs {
  cv::Mat detections;  ///< CV_32F
  cv::Mat masks;       ///< CV_32F
};

/// Throws Error with the shapes found where they are others.
void CheckTensorflowOutputs(const TensorflowMaskRcnnOutputs& outputs);

/// Label = class + 1, as in COCO's annotation files. The masks are headers onto `outputs`. Rows
/// with the score 0, with which OpenCV fills up, are left out.
std::vector<MaskRcnnDetection> ReadTensorflowDetections(const TensorflowMaskRcnnOutputs& outputs,
                                                        cv::Size input);

/// Who exported an ONNX network, which decides what it takes and how its numbers are meant.
enum class MaskRcnnExport {
  kTorchvision,  ///< RGB / 255, scaled by the network; masks of the input's size; COCO's 91 labels
  kModelZoo,     ///< BGR less a mean, scaled by us; masks of the box; labels 1 to 80
};

/// The four outputs of an ONNX export.
struct OnnxMaskRcnnOutputs {
  OnnxTensor boxes;   ///< N × 4 reals: left, top, right, bottom [input px]
  OnnxTensor labels;  ///< N whole numbers; 0 is the background
  OnnxTensor scores;  ///< N reals
  OnnxTensor masks;   ///< N × 1 × height × width reals (or N × height × width): probabilities
};

/// Tells the outputs apart by type and shape, whatever their order and names. Throws Error with the
/// shapes found where they do not fit one another.
OnnxMaskRcnnOutputs SelectOnnxOutputs(std::span<const OnnxTensor> outputs);

/// torchvision's masks have the size of the input, the model zoo's do not.
MaskRcnnExport FindExporter(const OnnxMaskRcnnOutputs& outputs, cv::Size input);

/// The masks are headers onto `outputs`. The model zoo's boxes name their last pixel, torchvision's
/// end with it.
std::vector<MaskRcnnDetection> ReadOnnxDetections(const OnnxMaskRcnnOutputs& outputs,
                                                  MaskRcnnExport exporter);

}  // namespace ofm
