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
  kNone,     ///< no instances
  kMasks,    ///< instance PNGs from a folder
  kYoloSeg,  ///< ONNX network in the Ultralytics export layout
};

inline EnumNameList<SegmenterKind> EnumNames(SegmenterKind) {
  static constexpr std::array<std::pair<SegmenterKind, std::string_view>, 3> kNames{{
      {SegmenterKind::kNone, "none"},
      {SegmenterKind::kMasks, "masks"},
      {SegmenterKind::kYoloSeg, "yolo-seg"},
  }};
  return kNames;
}

struct PerceptionOptions {
  SegmenterKind segmenter = SegmenterKind::kNone;
  std::string model = {};             ///< path of the ONNX network
  std::string class_names_file = {};  ///< one class name a line; empty = COCO's 80
  std::string masks_folder = {};      ///< empty = "mask" in the sequence's folder
  std::string mask_class = "person";  ///< what the instances of masks_folder are
  /// Least class probability of an instance. Lower than usual for detection: a person missed costs
  /// the pose more than a wrong one does, and the map weighs labels by their confidence.
  double score_threshold = 0.15;
  double nms_threshold = 0.7;  ///< overlap (IoU) over which the weaker box is dropped
  int max_instances = 100;     ///< the most confident are kept
  int input_width = 0;         ///< of the network [px]; 0 = as the model file says
  int input_height = 0;        ///< of the network [px]; 0 = as the model file says
  OpticalFlowOptions flow = {};
  SegmentationScheduleOptions schedule = {};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("segmenter", self.segmenter, "what finds instances");
    visit("model", self.model, "path of the ONNX network");
    visit("class_names_file", self.class_names_file, "one class name a line; empty = COCO's 80");
    visit("masks_folder", self.masks_folder, "instance PNGs; empty = 'mask' in the sequence");
    visit("mask_class", self.mask_class, "class of the instances in masks_folder");
    visit("score_threshold", self.score_threshold, "least class probability", Range{0.001, 1});
    visit("nms_threshold", self.nms_threshold, "IoU over which the weaker box is dropped",
          Range{0, 1});
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
