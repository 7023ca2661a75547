#include "ofm/pipeline/view_collector.h"

#include <opencv2/imgproc.hpp>
#include <utility>

#include "ofm/pipeline/back_end.h"

namespace ofm {
namespace {

constexpr int kPixelStep = 2;  // of a view: a quarter of the pixels and of the time

cv::Mat Coarse(const cv::Mat& image) {
  cv::Mat coarse;
  if (image.empty()) return coarse;
  cv::resize(image, coarse, {image.cols / kPixelStep, image.rows / kPixelStep}, 0, 0,
             cv::INTER_NEAREST);
  return coarse;
}

/// What the map needs of a frame, coarser.
PreparedFrame Coarse(const PreparedFrame& prepared) {
  PreparedFrame coarse;
  coarse.frame.stamp_ns = prepared.frame.stamp_ns;
  coarse.frame.color = Coarse(prepared.frame.color);
  coarse.frame.depth_m = Coarse(prepared.frame.depth_m);
  coarse.dynamic.mask = Coarse(prepared.dynamic.mask);
  coarse.dynamic.unmapped = Coarse(prepared.dynamic.unmapped);
  for (const Instance& instance : prepared.segmentation.instances) {
    Instance small = instance;
    small.mask = Coarse(instance.mask);
    small.box = cv::boundingRect(small.mask);
    coarse.segmentation.instances.push_back(std::move(small));
  }
  return coarse;
}

}  // namespace

void ViewCollector::Add(const PreparedFrame& prepared, const TrackingResult& result) {
  if (stride_ == 0 || ++frames_ < stride_now_ || !HasPose(result.status)) return;
  frames_ = 0;
  views_.push_back({MakeLabelledFrame(Coarse(prepared), result.depth_from_color), result.reference,
                    result.camera_from_reference});
  if (views_.size() == kMaxViews) ThinOut();
}

/// Drops each second view, and takes half as many from now on.
void ViewCollector::ThinOut() {
  std::size_t index = 0;
  std::erase_if(views_, [&](const View&) { return index++ % 2 == 0; });
  stride_now_ *= 2;
}

std::vector<LabelledFrame> ViewCollector::Take(const KeyframeCandidate& keyframe,
                                               const MapSnapshot& map) {
  frames_ = 0;
  stride_now_ = stride_;
  std::vector<LabelledFrame> taken;
  for (View& view : std::exchange(views_, {})) {
    const auto camera_from_world = map.FindKeyframePose(view.reference);
    if (!camera_from_world || keyframe.begins_submap) continue;
    if (map.FindSubmap(view.reference) != map.FindSubmap(keyframe.reference)) continue;
    const RigidTransform keyframe_from_view =
        keyframe.camera_from_world * (view.camera_from_reference * *camera_from_world).Inverse();
    view.frame.keyframe_from_depth = keyframe_from_view * view.frame.keyframe_from_depth;
    taken.push_back(std::move(view.frame));
  }
  return taken;
}

}  // namespace ofm
