#include "ofm/perception/make_segmenter.h"

#include "ofm/base/check.h"
#include "ofm/base/error.h"
#include "ofm/perception/class_names.h"
#include "ofm/perception/mask_folder_segmenter.h"
#include "ofm/perception/mask_rcnn_segmenter.h"
#include "ofm/perception/null_segmenter.h"
#include "ofm/perception/onnx_mask_rcnn.h"
#include "ofm/perception/tensorflow_mask_rcnn.h"
#include "ofm/perception/yolo_seg_segmenter.h"

namespace ofm {
namespace {

std::vector<std::string> ClassNamesFor(const PerceptionOptions& options) {
  if (options.class_names_file.empty()) return CocoClassNames();
  return LoadClassNames(options.class_names_file);
}

/// Of the network's input; empty where the options leave it to the network.
cv::Size InputSizeOf(const PerceptionOptions& options) {
  if ((options.input_width == 0) != (options.input_height == 0)) {
    throw Error("perception.input_width and perception.input_height must be set together");
  }
  return {options.input_width, options.input_height};
}

std::unique_ptr<Segmenter> MakeYolo(const PerceptionOptions& options) {
  const YoloSegModel model{options.model, ClassNamesFor(options), InputSizeOf(options)};
  const YoloDecoderOptions decoder{options.score_threshold, options.nms_threshold,
                                   options.max_instances};
  return std::make_unique<YoloSegSegmenter>(model, decoder);
}

/// Told apart by the model's extension.
std::unique_ptr<MaskRcnnNetwork> MakeMaskRcnnNetwork(const PerceptionOptions& options) {
  const std::filesystem::path model = options.model;
  if (model.empty()) {
    throw Error(
        "no network given; set perception.model (--model) to a TensorFlow graph (.pb) or an "
        "ONNX file; 'ofm-slam models' lists some");
  }
  if (model.extension() == ".onnx") {
    return std::make_unique<OnnxMaskRcnn>(model, InputSizeOf(options));
  }
  if (model.extension() != ".pb") {
    throw Error(model, "is neither a TensorFlow graph (.pb) nor an ONNX file (.onnx)");
  }
  std::filesystem::path text_graph = options.model_graph;
  if (text_graph.empty()) {
    text_graph = std::filesystem::path(model).replace_extension(".pbtxt");
    if (!std::filesystem::exists(text_graph)) {
      throw Error(text_graph,
                  "does not exist; set perception.model_graph (--model-graph) to OpenCV's "
                  "text graph of this network");
    }
  }
  return std::make_unique<TensorflowMaskRcnn>(
      TensorflowMaskRcnnModel{model, text_graph, InputSizeOf(options)});
}

std::unique_ptr<Segmenter> MakeMaskRcnn(const PerceptionOptions& options) {
  std::vector<std::string> names;
  if (!options.class_names_file.empty()) names = LoadClassNames(options.class_names_file);
  const MaskRcnnDecoderOptions decoder{options.score_threshold, options.mask_threshold,
                                       options.min_area_px, options.max_instances};
  return std::make_unique<MaskRcnnSegmenter>(MakeMaskRcnnNetwork(options), std::move(names),
                                             decoder);
}

}  // namespace

std::unique_ptr<Segmenter> MakeSegmenter(const PerceptionOptions& options,
                                         const std::filesystem::path& sequence_folder) {
  switch (options.segmenter) {
    case SegmenterKind::kNone:
      return std::make_unique<NullSegmenter>();
    case SegmenterKind::kMasks: {
      const std::filesystem::path folder = options.masks_folder.empty()
                                               ? sequence_folder / "mask"
                                               : std::filesystem::path(options.masks_folder);
      return std::make_unique<MaskFolderSegmenter>(
          MaskFolder{folder, ClassNamesFor(options), options.mask_class});
    }
    case SegmenterKind::kYoloSeg:
      return MakeYolo(options);
    case SegmenterKind::kMaskRcnn:
      return MakeMaskRcnn(options);
  }
  OFM_CHECK(false);
  return nullptr;
}

}  // namespace ofm
