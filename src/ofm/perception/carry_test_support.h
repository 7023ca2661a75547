// A textured object that moves in front of a textured wall. Tests only.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "ofm/perception/lattice_flow.h"
#include "ofm/perception/segmentation.h"
#include "ofm/perception/test_support.h"
#include "ofm/sim/sim_sequence.h"

namespace ofm::test {

/// An ellipse in front of a wall, at any place.
struct CarryScene {
  cv::Size size = {320, 240};
  cv::Size radii = {35, 60};
  float object_m = 1.2F, wall_m = 2.5F;
  bool is_plain = false;       ///< the object has no texture
  bool measures_depth = true;  ///< of the object
  cv::Point2f wall_shift = {0, 0};

  cv::Mat Mask(cv::Point2f centre) const {
    cv::Mat mask = cv::Mat::zeros(size, CV_8UC1);
    cv::ellipse(mask,
                cv::RotatedRect(centre, cv::Size2f(2.0F * radii.width, 2.0F * radii.height), 0),
                cv::Scalar(255), cv::FILLED);
    return mask;
  }

  Instance MakeInstance(cv::Point2f centre) const {
    const cv::Mat mask = Mask(centre);
    return {InstanceId(3), ClassId(0), 0.8F, cv::boundingRect(mask), mask};
  }

  cv::Mat Gray(cv::Point2f centre) const {
    cv::Mat wall = Shifted(MakeTexture(size, 1), wall_shift);
    const cv::Point2f middle(size.width / 2.0F, size.height / 2.0F);
    const cv::Mat object = is_plain ? cv::Mat(size, CV_8UC1, cv::Scalar(120))
                                    : Shifted(MakeTexture(size, 2), centre - middle);
    object.copyTo(wall, Mask(centre));
    return wall;
  }

  RgbdFrame Frame(std::uint32_t id, cv::Point2f centre) const {
    RgbdFrame frame;
    frame.id = FrameId(id);
    frame.stamp_ns = 1'000'000'000 + id * std::int64_t{33'000'000};
    frame.gray = Gray(centre);
    cv::cvtColor(frame.gray, frame.color, cv::COLOR_GRAY2BGR);
    frame.depth_m = cv::Mat(size, CV_32FC1, cv::Scalar(wall_m));
    frame.depth_m.setTo(measures_depth ? object_m : 0.0F, Mask(centre));
    return frame;
  }

  /// The camera that sees it.
  PinholeCamera camera() const { return MakeSimCamera(size.width, size.height); }

  static cv::Mat Shifted(const cv::Mat& image, cv::Point2f shift) {
    const cv::Mat transform = (cv::Mat_<double>(2, 3) << 1, 0, shift.x, 0, 1, shift.y);
    cv::Mat moved;
    cv::warpAffine(image, moved, transform, image.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT_101);
    return moved;
  }
};

/// Intersection over union; 1 for two empty masks.
inline double Iou(const cv::Mat& a, const cv::Mat& b) {
  const int either = cv::countNonZero(a | b);
  return either == 0 ? 1 : cv::countNonZero(a & b) / static_cast<double>(either);
}

}  // namespace ofm::test
