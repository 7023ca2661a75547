// From the output tensors of a YOLO segmentation network to instances.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "ofm/perception/letterbox.h"
#include "ofm/perception/segmentation.h"

namespace ofm {

/// The two outputs of a network in the Ultralytics export layout with C classes and M prototypes.
struct YoloOutputs {
  /// CV_32FC1, (4 + C + M) × cells: centre x, y, width, height [input px, continuous], C class
  /// probabilities, M mask coefficients.
  cv::Mat cells;
  /// CV_32FC1, M × (height · width) of the prototype masks.
  cv::Mat prototypes;
  cv::Size prototype_size;  ///< [px]
};

/// Tells the outputs apart by their rank (cells 3, prototypes 4), in whichever order they come.
/// Returns headers onto the same data; only YOLOv5's cells (1 × cells × 5 + C + M, one a row, with
/// an objectness as the fifth number) are brought into this order. Throws Error with the shapes
/// found where they do not fit one another or `class_count`.
YoloOutputs SelectYoloOutputs(const std::vector<cv::Mat>& outputs, int class_count);

struct YoloDecoderOptions {
  double score_threshold = 0.25;  ///< least class probability
  double nms_threshold = 0.7;     ///< overlap (IoU) over which the weaker box of a class is dropped
  int max_instances = 100;        ///< the most confident are kept
};

/// Instances in the pixels of the letterboxed image, the most confident first. Each cell has its
/// likeliest class; boxes of the same class suppress one another; mask = sigmoid(coefficients ·
/// prototypes) > 1/2, interpolated bilinearly at the image's pixel centres inside the box. Cells
/// with a number that is not finite, and masks without a pixel, are dropped.
std::vector<Instance> DecodeYolo(const YoloOutputs& outputs, const Letterbox& letterbox,
                                 const YoloDecoderOptions& options);

}  // namespace ofm
