// Mask R-CNN of TensorFlow's object detection API, run by OpenCV: a frozen graph and OpenCV's text
// graph for it, such as mask_rcnn_inception_v2_coco_2018_01_28.
#pragma once

#include <filesystem>
#include <opencv2/dnn/dnn.hpp>

#include "ofm/perception/mask_rcnn_input.h"
#include "ofm/perception/mask_rcnn_network.h"
#include "ofm/perception/mask_rcnn_outputs.h"

namespace ofm {

struct TensorflowMaskRcnnModel {
  std::filesystem::path graph;       ///< frozen graph (.pb): the weights
  std::filesystem::path text_graph;  ///< as OpenCV's tf_text_graph_mask_rcnn.py writes it (.pbtxt)
  cv::Size input;  ///< empty = the shorter side is 800 px, the longer at most 1365
};

class TensorflowMaskRcnn : public MaskRcnnNetwork {
 public:
  /// Loads the network and runs it once on a grey image. Throws Error that names the file which is
  /// missing or cannot be used. Meanwhile OpenCV's log level is lowered for the whole process.
  explicit TensorflowMaskRcnn(const TensorflowMaskRcnnModel& model);

  Letterbox Fit(cv::Size image) const override;
  std::vector<MaskRcnnDetection> Detect(const cv::Mat& image, const Letterbox& letterbox) override;
  ClassMap MapToCoco() const override;
  ClassMap MapToNames(int class_count) const override;

 private:
  TensorflowMaskRcnnModel model_;
  cv::dnn::Net net_;
  TensorflowMaskRcnnOutputs outputs_;
  int class_count_ = 0;
};

}  // namespace ofm
