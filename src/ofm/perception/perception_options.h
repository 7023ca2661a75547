// Which segmenter is used and how.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "ofm/base/options.h"
#include "ofm/perception/optical_flow.h"
#include "ofm/perception/segmentation_schedule.h"

namespace ofm {

enum class SegmenterKind {
  kNone,      ///< no instances
  kMasks,     ///< instance PNGs from a folder
  kYoloSeg,   ///< ONNX network in the Ultralytics export layout
  kMaskRcnn,  ///< TensorFlow graph, or ONNX export of torchvision or the ONNX model zoo
};

inline EnumNameList<SegmenterKind> EnumNames(SegmenterKind) {
  static constexpr std::array<std::pair<SegmenterKind, std::string_view>, 4> kNames{{
      {SegmenterKind::kNone, "none"},
      {SegmenterKind::kMasks, "masks"},
      {SegmenterKind::kYoloSeg, "yolo-seg"},
      {SegmenterKind::kMaskRcnn, "mask-rcnn"},
  }};
  return kNames;
}

struct PerceptionOptions {
  SegmenterKind segmenter = SegmenterKind::kNone;
  std::string model = {};             ///< path of the network: ONNX, or a TensorFlow graph (.pb)
  std::string model_graph = {};       ///< OpenCV's text graph for a .pb; empty = .pbtxt beside it
  std::string class_names_file = {};  ///< one class name a line; empty = COCO's 80
  std::string masks_folder = {};      ///< empty = "mask" in the sequence's folder
  std::string mask_class = "person";  ///< what the instances of masks_folder are
  /// Least class probability of an instance. Lower than usual for detection: a person missed costs
  /// the pose more than a wrong one does, and the map weighs labels by their confidence.
  double score_threshold = 0.15;
  double nms_threshold = 0.7;   ///< overlap (IoU) over which the weaker box is dropped
  double mask_threshold = 0.5;  ///< Mask R-CNN: a pixel's probability exceeds this in its mask
  int min_area_px = 0;          ///< Mask R-CNN: masks with fewer pixels are dropped
  int max_instances = 100;      ///< the most confident are kept
  int input_width = 0;          ///< of the network [px]; 0 = as the model file says or was trained
  int input_height = 0;         ///< of the network [px]; 0 = as the model file says or was trained
  OpticalFlowOptions flow = {};
  SegmentationScheduleOptions schedule = {};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("segmenter", self.segmenter, "what finds instances");
    visit("model", self.model, "path of the network: ONNX, or for mask-rcnn also TensorFlow's .pb");
    visit("model_graph", self.model_graph,
          "OpenCV's text graph for a .pb; empty = the .pbtxt beside it");
    visit("class_names_file", self.class_names_file, "one class name a line; empty = COCO's 80");
    visit("masks_folder", self.masks_folder, "instance PNGs; empty = 'mask' in the sequence");
    visit("mask_class", self.mask_class, "class of the instances in masks_folder");
    visit("score_threshold", self.score_threshold, "least class probability", Range{0.001, 1});
    visit("nms_threshold", self.nms_threshold, "IoU over which the weaker box is dropped",
          Range{0, 1});
    visit("mask_threshold", self.mask_threshold, "least probability of a pixel; mask-rcnn only",
          Range{0, 1});
    visit("min_area_px", self.min_area_px, "smaller masks are dropped [px]; mask-rcnn only",
          Range{0, 100'000'000});
    visit("max_instances", self.max_instances, "instances kept per frame", Range{1, 255});
    visit("input_width", self.input_width, "network input [px]; 0 = as the model says",
          Range{0, 4096});
    visit("input_height", self.input_height, "network input [px]; 0 = as the model says",
          Range{0, 4096});
    visit("flow", self.flow, "sparse optical flow");
    visit("schedule", self.schedule, "when the network runs");
  }
};

}  // namespace ofm
