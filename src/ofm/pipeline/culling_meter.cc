#include "ofm/pipeline/culling_meter.h"

#include <cmath>

namespace ofm {
namespace {

bool IsSet(const cv::Mat& mask, const Keypoint& keypoint) {
  if (mask.empty()) return false;
  const cv::Point pixel(static_cast<int>(std::lround(keypoint.pixel.x())),
                        static_cast<int>(std::lround(keypoint.pixel.y())));
  return mask.at<std::uint8_t>(pixel) != 0;
}

cv::Mat UnionOf(const Segmentation& segmentation, cv::Size size) {
  cv::Mat mask = cv::Mat::zeros(size, CV_8UC1);
  for (const Instance& instance : segmentation.instances) mask.setTo(255, instance.mask);
  return mask;
}

OrbOptions WithoutPatches(OrbOptions options) {
  options.patches = false;
  return options;
}

}  // namespace

CullingMeter::CullingMeter(const std::filesystem::path& true_masks, const OrbOptions& features)
    : truth_(MaskFolder{true_masks, {}, "person", MaskFiles::kImages}),
      extractor_(WithoutPatches(features)) {}

void CullingMeter::OnFrame(const FrameReport& report) {
  const RgbdFrame& frame = report.prepared.frame;
  const cv::Mat actors = UnionOf(truth_.Segment(frame), frame.gray.size());
  for (const Keypoint& keypoint : extractor_.Extract(frame.gray, {}).keypoints) {
    const bool kept = !IsSet(report.prepared.dynamic.mask, keypoint);
    const bool on_actor = IsSet(actors, keypoint);
    (on_actor ? counts_.actor_features : counts_.static_features) += 1;
    (on_actor ? counts_.actor_features_kept : counts_.static_features_kept) += kept;
  }
  const auto& keypoints = report.prepared.features->keypoints;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const bool in_pose = report.tracking.landmarks[i].valid();
    counts_.actor_features_in_pose += in_pose && IsSet(actors, keypoints[i]);
  }
}

}  // namespace ofm
