#include "ofm/perception/mask_rcnn_decoder.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "ofm/perception/mask_sampling.h"

namespace ofm {
namespace {

bool IsUsable(const MaskRcnnDetection& detection, const ClassMap& classes, double score_threshold) {
  const cv::Rect2d& box = detection.box;
  const bool finite = std::isfinite(box.x) && std::isfinite(box.y) && std::isfinite(box.width) &&
                      std::isfinite(box.height);
  // A score that is not a number fails the comparison.
  return detection.score >= score_threshold && finite && box.width > 0 && box.height > 0 &&
         !detection.mask.empty() && FindClassOfLabel(classes, detection.label).valid();
}

/// What the detection's mask covers [image px, continuous].
cv::Rect2d ExtentOf(const MaskRcnnDetection& detection, const Letterbox& letterbox) {
  const cv::Rect2d in_input = detection.extent == MaskExtent::kBox
                                  ? detection.box
                                  : cv::Rect2d({0, 0}, cv::Size2d(letterbox.input));
  return {cv::Point2d(letterbox.ImageX(in_input.x), letterbox.ImageY(in_input.y)),
          cv::Point2d(letterbox.ImageX(in_input.x + in_input.width),
                      letterbox.ImageY(in_input.y + in_input.height))};
}

}  // namespace

std::vector<Instance> DecodeMaskRcnn(std::span<const MaskRcnnDetection> detections,
                                     const Letterbox& letterbox, const ClassMap& classes,
                                     const MaskRcnnDecoderOptions& options) {
  std::vector<const MaskRcnnDetection*> order;
  for (const MaskRcnnDetection& detection : detections) {
    if (IsUsable(detection, classes, options.score_threshold)) order.push_back(&detection);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto* a, const auto* b) { return a->score > b->score; });

  const int min_area_px = std::max(options.min_area_px, 1);
  std::vector<Instance> instances;
  for (const MaskRcnnDetection* detection : order) {
    if (std::ssize(instances) >= options.max_instances) break;
    Instance instance;
    instance.id = InstanceId(static_cast<std::uint32_t>(instances.size()));
    instance.class_id = FindClassOfLabel(classes, detection->label);
    instance.score = std::min(detection->score, 1.0F);
    instance.box = ImagePixelsIn(detection->box, letterbox);
    if (instance.box.area() < min_area_px) continue;
    instance.mask =
        PasteMask({detection->mask, ExtentOf(*detection, letterbox)},
                  static_cast<float>(options.mask_threshold), instance.box, letterbox.image);
    if (cv::countNonZero(instance.mask(instance.box)) < min_area_px) continue;
    instances.push_back(std::move(instance));
  }
  return instances;
}

}  // namespace ofm
