// From what a Mask R-CNN (He et al., ICCV 2017) detects in its input to instances in the image.
#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "ofm/perception/class_map.h"
#include "ofm/perception/letterbox.h"
#include "ofm/perception/segmentation.h"

namespace ofm {

/// What a mask of probabilities covers.
enum class MaskExtent {
  kBox,    ///< the detection's box: the mask is to be pasted there
  kInput,  ///< the whole network input
};

/// One object, in the pixels of the network's input.
struct MaskRcnnDetection {
  int label = 0;    ///< the network's own number of the class
  float score = 0;  ///< 0 to 1
  cv::Rect2d box;   ///< [input px, continuous: pixel i spans [i, i + 1]]
  cv::Mat mask;     ///< CV_32FC1, probabilities; may be a header onto the network's output
  MaskExtent extent = MaskExtent::kBox;
};

struct MaskRcnnDecoderOptions {
  double score_threshold = 0.5;
  double mask_threshold = 0.5;  ///< a pixel is the object's where its probability exceeds this
  int min_area_px = 0;          ///< masks with fewer pixels of the image are dropped
  int max_instances = 100;      ///< the most confident are kept
};

/// Instances in the pixels of the letterboxed image, the most confident first, of equals the one
/// detected first. Dropped are detections without a class in `classes`, with a box that has no area
/// or a number that is not finite, and masks without a pixel.
std::vector<Instance> DecodeMaskRcnn(std::span<const MaskRcnnDetection> detections,
                                     const Letterbox& letterbox, const ClassMap& classes,
                                     const MaskRcnnDecoderOptions& options);

}  // namespace ofm
