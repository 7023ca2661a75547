#include "ofm/dynamics/full_dynamics.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "ofm/dynamics/mask_dilation.h"
#include "ofm/dynamics/mask_upsampling.h"

namespace ofm {
namespace {

/// CV_8UC1, 255 = surely static. What nothing was told of has the prior's odds, and full weight.
cv::Mat StaticProbability(const cv::Mat& log_odds_of_moving) {
  constexpr double kNothingTold = 0.7;
  cv::Mat odds, probability;
  cv::exp(log_odds_of_moving, odds);
  cv::divide(255.0 / kNothingTold, odds + 1.0, probability, CV_8U);
  return probability;
}

}  // namespace

FullDynamics::FullDynamics(const DynamicsOptions& options, const PinholeCamera& camera,
                           std::vector<ClassId> dynamic_classes)
    : options_(options),
      dynamic_classes_(std::move(dynamic_classes)),
      judge_(camera, options.motion) {}

DynamicMask FullDynamics::Process(const RgbdFrame& frame, const Segmentation& segmentation) {
  const LatticeFrame lattice_frame = judge_.lattice().MakeFrame(frame);
  const std::int64_t last_stamp_ns = state_.last ? state_.last->stamp_ns : 0;
  const MotionVerdict verdict =
      judge_.Process({lattice_frame, InstancePrior(segmentation), frame.id.value}, state_);
  DynamicMask result;
  result.mask = cv::Mat::zeros(frame.gray.size(), CV_8UC1);
  AddDilated(UpsampleMask(judge_.lattice().cells(), verdict.belief > 0, lattice_frame.depth_m,
                          frame.depth_m),
             options_.motion.dilation_px, result.mask);
  result.static_probability = judge_.lattice().cells().ToImage(StaticProbability(verdict.belief));
  if (verdict.camera_motion.is_measured) {
    result.camera_motion =
        FrameMotion{last_stamp_ns, verdict.camera_motion.last_from_current.Inverse()};
  }
  result.masked_share =
      static_cast<double>(cv::countNonZero(result.mask)) / static_cast<double>(result.mask.total());
  return result;
}

cv::Mat FullDynamics::InstancePrior(const Segmentation& segmentation) const {
  const IdealLattice& cells = judge_.lattice().cells();
  cv::Mat prior(cells.size(), CV_32FC1, cv::Scalar(0));
  constexpr float kPresumedMoving = 4;
  for (const Instance& instance : segmentation.instances) {
    const bool is_dynamic = std::find(dynamic_classes_.begin(), dynamic_classes_.end(),
                                      instance.class_id) != dynamic_classes_.end();
    if (is_dynamic) prior.setTo(kPresumedMoving, cells.SampleNearest(instance.mask));
  }
  return prior;
}

}  // namespace ofm
