#include "ofm/objects/object_observation.h"

#include <opencv2/imgproc.hpp>

#include "ofm/base/check.h"
#include "ofm/dense/usable_pixels.h"
#include "ofm/dense/voxel_filter.h"
#include "ofm/dynamics/mask_refinement.h"

namespace ofm {

ObjectObserver::ObjectObserver(const PinholeCamera& camera, const ObjectObservationOptions& options,
                               const ClassPolicies& policies)
    : camera_(camera), options_(options), policies_(policies), ideal_px_(camera) {}

KeyframeObjects ObjectObserver::Observe(const InstanceFrame& frame) const {
  OFM_CHECK(frame.depth_m.type() == CV_32FC1 && frame.color.type() == CV_8UC3);
  OFM_CHECK(frame.depth_m.cols == camera_.width && frame.depth_m.rows == camera_.height);
  KeyframeObjects seen{frame.stamp_ns, SketchDepth(frame.depth_m), {}};
  const cv::Mat smooth = FindSmoothPixels(frame.depth_m, {});
  for (std::size_t place = 0; place < frame.instances.size(); ++place) {
    const Instance& instance = frame.instances[place];
    if (instance.score < options_.min_score) continue;
    if (!StandsStill(instance, frame.dynamic_mask)) continue;
    ObjectObservation observation = ObserveInstance(instance, frame, smooth);
    if (observation.points_in_camera.size() < static_cast<std::size_t>(options_.min_points)) {
      continue;
    }
    observation.instance = place;
    seen.observations.push_back(std::move(observation));
  }
  return seen;
}

bool ObjectObserver::StandsStill(const Instance& instance, const cv::Mat& dynamic_mask) const {
  const ClassPolicy policy = policies_.Of(instance.class_id);
  if (policy == ClassPolicy::kNeverDynamic) return true;
  if (policy != ClassPolicy::kUnknown) return false;
  if (dynamic_mask.empty()) return true;
  const int moving = cv::countNonZero(instance.mask & dynamic_mask);
  return moving <= options_.max_moving_share * cv::countNonZero(instance.mask);
}

ObjectObservation ObjectObserver::ObserveInstance(const Instance& instance,
                                                  const InstanceFrame& frame,
                                                  const cv::Mat& smooth) const {
  MaskRefinementOptions refinement;
  refinement.depth_margin_m = options_.depth_margin_m;
  cv::Mat mask = instance.mask;
  if (options_.erosion_px > 0) {
    const int side = 2 * options_.erosion_px + 1;
    mask = cv::Mat();  // the instance's is shared
    cv::erode(instance.mask, mask, cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side}));
  }
  mask = RefineMask(mask, frame.depth_m, refinement).mask & smooth;

  VoxelFilter filter(options_.point_spacing_m);
  const cv::Rect box = cv::boundingRect(mask);
  for (int row = box.y; row < box.y + box.height; ++row) {
    const auto* row_mask = mask.ptr<std::uint8_t>(row);
    for (int column = box.x; column < box.x + box.width; ++column) {
      if (row_mask[column] == 0) continue;
      const double depth = frame.depth_m.at<float>(row, column);
      if (depth > options_.range_m) continue;
      const Eigen::Vector3d point =
          camera_.UnprojectIdeal(ideal_px_.At(column, row).cast<double>(), depth);
      const cv::Vec3b& bgr = frame.color.at<cv::Vec3b>(row, column);
      filter.Add({point.cast<float>(), {bgr[2], bgr[1], bgr[0]}, kNoLabel, 0});
    }
  }
  ObjectObservation observation{instance.class_id, instance.score, {}, {}};
  const std::vector<LabelledPoint> points = filter.Points();
  Eigen::Vector3d color = Eigen::Vector3d::Zero();
  for (const LabelledPoint& point : points) {
    observation.points_in_camera.push_back(point.position);
    color += Eigen::Vector3d(point.color.r, point.color.g, point.color.b);
  }
  if (!points.empty()) observation.color = ToRgb(color / static_cast<double>(points.size()));
  return observation;
}

}  // namespace ofm
