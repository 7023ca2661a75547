// One class per pixel, as the semantic map takes it.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "ofm/perception/segmentation.h"

namespace ofm {

/// The label of a pixel that belongs to no instance.
inline constexpr std::uint8_t kNoLabel = 255;

/// The instance of a pixel that belongs to none.
inline constexpr std::uint16_t kNoInstance = 65535;

struct LabelImage {
  cv::Mat labels;      ///< CV_8UC1: ClassId, or kNoLabel
  cv::Mat confidence;  ///< CV_8UC1: the instance's score × 255, 0 without a label
  cv::Mat instances;   ///< CV_16UC1: place in Segmentation::instances, or kNoInstance
};

/// Where instances overlap the more confident one wins, and of equals the one listed first. Masks
/// must have the size `size` and class ids must be under 255.
LabelImage ComposeLabelImage(const Segmentation& segmentation, cv::Size size);

}  // namespace ofm
