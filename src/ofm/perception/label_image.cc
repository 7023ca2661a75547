#include "ofm/perception/label_image.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "ofm/base/check.h"

namespace ofm {

LabelImage ComposeLabelImage(const Segmentation& segmentation, cv::Size size) {
  std::vector<const Instance*> order;
  for (const Instance& instance : segmentation.instances) order.push_back(&instance);
  std::stable_sort(order.begin(), order.end(),
                   [](const Instance* a, const Instance* b) { return a->score > b->score; });

  LabelImage image{cv::Mat(size, CV_8UC1, cv::Scalar(kNoLabel)), cv::Mat::zeros(size, CV_8UC1),
                   cv::Mat(size, CV_16UC1, cv::Scalar(kNoInstance))};
  // The winner is painted last.
  for (auto it = order.rbegin(); it != order.rend(); ++it) {
    const Instance& instance = **it;
    OFM_CHECK(instance.class_id.value < kNoLabel && instance.mask.size() == size);
    const double score = std::clamp(static_cast<double>(instance.score), 0.0, 1.0);
    const cv::Mat mask = instance.mask(instance.box);
    image.labels(instance.box).setTo(cv::Scalar(instance.class_id.value), mask);
    const auto place = &instance - segmentation.instances.data();
    image.instances(instance.box).setTo(cv::Scalar(static_cast<double>(place)), mask);
    image.confidence(instance.box).setTo(cv::Scalar(std::round(score * 255)), mask);
  }
  return image;
}

}  // namespace ofm
