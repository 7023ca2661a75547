#include "ofm/perception/onnx_mask_rcnn.h"

#include <fmt/format.h>

#include "ofm/base/error.h"

namespace ofm {
namespace {

constexpr int kZooMultiple = 32;  // its feature pyramid halves the input five times

/// The size that `shape` (3 × H × W, with or without a batch of 1) or `wanted` fixes; empty where
/// it is left open.
cv::Size FindFixedInput(const OnnxRuntimeNetwork& network, cv::Size wanted) {
  const auto& shape = network.input_shape();
  const bool image = (shape.size() == 3 || (shape.size() == 4 && shape[0] <= 1)) &&
                     (shape[shape.size() - 3] == 3 || shape[shape.size() - 3] == 0);
  if (!image) {
    throw Error(network.path(),
                "does not take one colour image (3 x height x width); export it so");
  }
  const auto height = shape[shape.size() - 2], width = shape.back();
  if (height == 0 || width == 0) return wanted;
  constexpr std::int64_t kMaxSide = 4096;
  if (height > kMaxSide || width > kMaxSide) {
    throw Error(network.path(),
                fmt::format("takes images over {} px; export it smaller", kMaxSide));
  }
  const cv::Size fixed(static_cast<int>(width), static_cast<int>(height));
  if (!wanted.empty() && wanted != fixed) {
    throw Error(network.path(),
                fmt::format("takes images of {} x {} px only; leave perception.input_width and "
                            "input_height at 0",
                            width, height));
  }
  return fixed;
}

}  // namespace

OnnxMaskRcnn::OnnxMaskRcnn(const std::filesystem::path& path, cv::Size input)
    : network_(path), input_(FindFixedInput(network_, input)) {
  const cv::Size trial = input_.empty() ? cv::Size(320, 256) : input_;
  const int shape[] = {3, trial.height, trial.width};
  exporter_ = FindExporter(Run(cv::Mat(3, shape, CV_32F, cv::Scalar(0))), trial);
}

Letterbox OnnxMaskRcnn::Fit(cv::Size image) const {
  if (exporter_ == MaskRcnnExport::kTorchvision) {
    return FitMaskRcnnInput(image, {.fixed = input_, .shorter_side = 0});
  }
  // The zoo's export clips boxes to the 1280 x 960 px that it was traced with.
  return FitMaskRcnnInput(image, {.fixed = input_, .most = {1280, 960}, .multiple = kZooMultiple});
}

std::vector<MaskRcnnDetection> OnnxMaskRcnn::Detect(const cv::Mat& image,
                                                    const Letterbox& letterbox) {
  const MaskRcnnColors colors =
      exporter_ == MaskRcnnExport::kTorchvision
          ? MaskRcnnColors{.scale = 1.0 / 255}
          : MaskRcnnColors{MaskRcnnColors::Order::kBgr, {102.9801, 115.9465, 122.7717}, 1};
  return ReadOnnxDetections(Run(MakeMaskRcnnBlob(letterbox, image, colors)), exporter_);
}

ClassMap OnnxMaskRcnn::MapToCoco() const {
  return exporter_ == MaskRcnnExport::kTorchvision ? MakeCoco91ClassMap()
                                                   : MakeContiguousClassMap(80);
}

ClassMap OnnxMaskRcnn::MapToNames(int class_count) const {
  return MakeContiguousClassMap(class_count);  // the outputs do not say how many there are
}

OnnxMaskRcnnOutputs OnnxMaskRcnn::Run(const cv::Mat& blob) {
  if (network_.input_shape().size() == 4) {
    const int shape[] = {1, 3, blob.size[1], blob.size[2]};
    network_.Run(blob.reshape(1, 4, shape));
  } else {
    network_.Run(blob);
  }
  try {
    return SelectOnnxOutputs(network_.outputs());
  } catch (const Error& error) {
    throw Error(network_.path(), error.what());
  }
}

}  // namespace ofm
