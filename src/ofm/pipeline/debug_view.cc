#include "ofm/pipeline/debug_view.h"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

namespace ofm {
namespace {

const cv::Scalar kGreen(0, 220, 0), kBlue(255, 120, 0), kRed(0, 0, 255), kWhite(255, 255, 255);

cv::Point PixelOf(const Eigen::Vector2f& place) {
  return {static_cast<int>(std::lround(place.x())), static_cast<int>(std::lround(place.y()))};
}

/// A colour that stays the same for an instance's number.
cv::Scalar ColorOf(InstanceId id) {
  const std::uint32_t hash = id.value * 2654435761U;
  return cv::Scalar(80 + (hash & 127), 80 + (hash >> 8 & 127), 80 + (hash >> 16 & 127));
}

void Write(cv::Mat& image, const std::string& text, cv::Point place) {
  cv::putText(image, text, place, cv::FONT_HERSHEY_SIMPLEX, 0.5, cv::Scalar(0, 0, 0), 3);
  cv::putText(image, text, place, cv::FONT_HERSHEY_SIMPLEX, 0.5, kWhite, 1);
}

void Tint(cv::Mat& image, const cv::Scalar& color, const cv::Mat& mask) {
  if (mask.empty()) return;
  cv::Mat tinted;
  cv::addWeighted(image, 0.5, cv::Mat(image.size(), image.type(), color), 0.5, 0, tinted);
  tinted.copyTo(image, mask);
}

cv::Mat DrawStaticOnly(const PreparedFrame& prepared) {
  cv::Mat image = prepared.frame.color.clone();
  if (!prepared.dynamic.mask.empty()) image.setTo(cv::Scalar::all(0), prepared.dynamic.mask);
  return image;
}

cv::Mat DrawFlow(const PreparedFrame& prepared) {
  cv::Mat image = prepared.frame.color / 2;
  for (const FlowVector& flow : prepared.dynamic.flow) {
    const cv::Point from = PixelOf(flow.last_px), to = PixelOf(flow.current_px);
    cv::line(image, from, to, flow.is_moving ? kRed : kGreen, 1, cv::LINE_AA);
    cv::circle(image, to, 1, flow.is_moving ? kRed : kGreen, cv::FILLED);
  }
  return image;
}

cv::Mat DrawFeatures(const FrameReport& report) {
  cv::Mat image = report.prepared.frame.color.clone();
  const auto& keypoints = report.prepared.features->keypoints;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const bool in_pose = report.tracking.landmarks[i].valid();
    cv::circle(image, PixelOf(keypoints[i].pixel), 2, in_pose ? kGreen : kBlue, cv::FILLED);
  }
  for (const FlowVector& flow : report.prepared.dynamic.flow) {
    if (flow.is_moving) cv::circle(image, PixelOf(flow.current_px), 2, kRed, cv::FILLED);
  }
  const bool has_pose = HasPose(report.tracking.status);
  Write(image,
        fmt::format("frame {}  {}  {} inliers", report.prepared.frame.id.value,
                    has_pose ? "tracked" : "no pose", report.tracking.inliers),
        {8, 20});
  return image;
}

}  // namespace

cv::Mat DrawMasks(const PreparedFrame& prepared, const std::vector<std::string>& class_names) {
  cv::Mat image = prepared.frame.color.clone();
  Tint(image, kRed, prepared.dynamic.mask);
  for (const Instance& instance : prepared.segmentation.instances) {
    std::vector<std::vector<cv::Point>> outline;
    cv::findContours(instance.mask.clone(), outline, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
    cv::drawContours(image, outline, -1, ColorOf(instance.id), 2);
    const bool is_named = instance.class_id.value < class_names.size();
    Write(image,
          fmt::format("{} {:.2f}", is_named ? class_names[instance.class_id.value] : "?",
                      instance.score),
          instance.box.tl() + cv::Point(4, 16));
  }
  return image;
}

cv::Mat DrawDebugView(const FrameReport& report, const std::vector<std::string>& class_names) {
  cv::Mat upper, lower, view;
  cv::hconcat(DrawMasks(report.prepared, class_names), DrawStaticOnly(report.prepared), upper);
  cv::hconcat(DrawFlow(report.prepared), DrawFeatures(report), lower);
  cv::vconcat(upper, lower, view);
  return view;
}

}  // namespace ofm
