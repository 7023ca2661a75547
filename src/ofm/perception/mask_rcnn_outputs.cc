#include "ofm/perception/mask_rcnn_outputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "ofm/base/error.h"

namespace ofm {
namespace {

constexpr int kDetectionColumns = 7;

std::string ShapeOf(const cv::Mat& tensor) {
  const std::vector<int> sizes(tensor.size.p, tensor.size.p + tensor.dims);
  return fmt::format("{}", fmt::join(sizes, "x"));
}

bool IsReal(const OnnxTensor& tensor) { return tensor.type == OnnxTensor::Type::kReal; }

std::string ShapesOf(std::span<const OnnxTensor> tensors) {
  std::vector<std::string> shapes;
  for (const OnnxTensor& tensor : tensors) {
    shapes.push_back(fmt::format("{} {}{}", tensor.name, fmt::join(tensor.shape, "x"),
                                 IsReal(tensor) ? "" : " whole"));
  }
  return fmt::format("{}", fmt::join(shapes, ", "));
}

/// A box from its edges; without area where they are the wrong way round or no numbers.
cv::Rect2d BoxFromEdges(double left, double top, double right, double bottom) {
  return {left, top, right - left, bottom - top};
}

/// A number of a class, which a network gives as a real; -1 where it is none.
int WholeOf(float real) {
  return std::isfinite(real) && std::abs(real) < 1e6F ? static_cast<int>(std::lround(real)) : -1;
}

}  // namespace

void CheckTensorflowOutputs(const TensorflowMaskRcnnOutputs& outputs) {
  const cv::Mat &detections = outputs.detections, &masks = outputs.masks;
  const bool fits = detections.type() == CV_32F && masks.type() == CV_32F && detections.dims == 4 &&
                    masks.dims == 4 && detections.size[3] == kDetectionColumns &&
                    detections.size[0] * detections.size[1] == 1 &&
                    detections.size[2] == masks.size[0] && masks.size[1] > 0;
  if (!fits) {
    throw Error(
        fmt::format("the outputs ({}, {}) are not those of a Mask R-CNN (1x1xNx7 and "
                    "Nxclassesxheightxwidth)",
                    ShapeOf(detections), ShapeOf(masks)));
  }
}

std::vector<MaskRcnnDetection> ReadTensorflowDetections(const TensorflowMaskRcnnOutputs& outputs,
                                                        cv::Size input) {
  CheckTensorflowOutputs(outputs);
  const cv::Mat& masks = outputs.masks;
  std::vector<MaskRcnnDetection> detections;
  for (int i = 0; i < masks.size[0]; ++i) {
    const float* row = outputs.detections.ptr<float>() + i * kDetectionColumns;
    const int class_index = WholeOf(row[1]);
    if (!(row[2] > 0) || class_index < 0 || class_index >= masks.size[1]) continue;
    MaskRcnnDetection detection;
    detection.label = class_index + 1;
    detection.score = row[2];
    detection.box = BoxFromEdges(
        static_cast<double>(row[3]) * input.width, static_cast<double>(row[4]) * input.height,
        static_cast<double>(row[5]) * input.width, static_cast<double>(row[6]) * input.height);
    // Only a header: nobody writes through it.
    detection.mask = cv::Mat(masks.size[2], masks.size[3], CV_32FC1,
                             const_cast<float*>(masks.ptr<float>(i, class_index)));
    detections.push_back(detection);
  }
  return detections;
}

OnnxMaskRcnnOutputs SelectOnnxOutputs(std::span<const OnnxTensor> outputs) {
  OnnxMaskRcnnOutputs selected;
  for (const OnnxTensor& output : outputs) {
    const std::size_t rank = output.shape.size();
    if (!IsReal(output) && rank == 1) {
      selected.labels = output;
    } else if (IsReal(output) && rank == 1) {
      selected.scores = output;
    } else if (IsReal(output) && rank == 2 && output.shape[1] == 4) {
      selected.boxes = output;
    } else if (IsReal(output) && (rank == 3 || (rank == 4 && output.shape[1] == 1))) {
      selected.masks = output;
    }
  }
  const auto counts = [&](const OnnxTensor& tensor) {
    return !tensor.shape.empty() && tensor.shape[0] == selected.scores.shape[0];
  };
  if (selected.scores.shape.empty() || !counts(selected.boxes) || !counts(selected.labels) ||
      !counts(selected.masks)) {
    throw Error(
        fmt::format("the outputs ({}) are not those of a Mask R-CNN: boxes (Nx4), labels "
                    "(N whole), scores (N) and masks (Nx1xheightxwidth)",
                    ShapesOf(outputs)));
  }
  return selected;
}

MaskRcnnExport FindExporter(const OnnxMaskRcnnOutputs& outputs, cv::Size input) {
  const auto& shape = outputs.masks.shape;
  const bool full = shape[shape.size() - 2] == input.height && shape.back() == input.width;
  return full ? MaskRcnnExport::kTorchvision : MaskRcnnExport::kModelZoo;
}

std::vector<MaskRcnnDetection> ReadOnnxDetections(const OnnxMaskRcnnOutputs& outputs,
                                                  MaskRcnnExport exporter) {
  const bool zoo = exporter == MaskRcnnExport::kModelZoo;
  const double last_pixel = zoo ? 1 : 0;
  const auto& shape = outputs.masks.shape;
  const int height = static_cast<int>(shape[shape.size() - 2]);
  const int width = static_cast<int>(shape.back());
  std::vector<MaskRcnnDetection> detections;
  for (std::size_t i = 0; i < outputs.scores.reals.size(); ++i) {
    const float* box = outputs.boxes.reals.data() + 4 * i;
    MaskRcnnDetection detection;
    detection.label =
        static_cast<int>(std::clamp<std::int64_t>(outputs.labels.wholes[i], -1, 1'000'000));
    detection.score = outputs.scores.reals[i];
    detection.box = BoxFromEdges(box[0], box[1], box[2] + last_pixel, box[3] + last_pixel);
    const float* mask = outputs.masks.reals.data() + i * static_cast<std::size_t>(height) * width;
    // Only a header: nobody writes through it.
    detection.mask = cv::Mat(height, width, CV_32FC1, const_cast<float*>(mask));
    detection.extent = zoo ? MaskExtent::kBox : MaskExtent::kInput;
    detections.push_back(detection);
  }
  return detections;
}

}  // namespace ofm
