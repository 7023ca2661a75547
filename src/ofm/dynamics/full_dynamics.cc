#include "ofm/dynamics/full_dynamics.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "ofm/base/time.h"
#include "ofm/dynamics/mask_dilation.h"
#include "ofm/perception/mask_upsampling.h"

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

/// Of every fourth cell in both directions that has texture.
std::vector<FlowVector> DrawnFlow(const MotionVerdict& verdict, const LatticeStep& step,
                                  const IdealLattice& cells, const PinholeCamera& camera) {
  constexpr int kStep = 4;
  std::vector<FlowVector> vectors;
  for (int y = 0; y < step.flow.rows; y += kStep) {
    for (int x = 0; x < step.flow.cols; x += kStep) {
      if (step.frame.texture.at<std::uint8_t>(y, x) == 0) continue;
      const cv::Vec2f flow = step.flow.at<cv::Vec2f>(y, x);
      const auto pixel_at = [&](double column, double row) {
        return camera.Distort(cells.IdealPx(column, row)).cast<float>().eval();
      };
      vectors.push_back(
          {pixel_at(x + flow[0], y + flow[1]), pixel_at(x, y), verdict.belief.at<float>(y, x) > 0});
    }
  }
  return vectors;
}

double ShareOf(const cv::Mat& mask) {
  return static_cast<double>(cv::countNonZero(mask)) / static_cast<double>(mask.total());
}

}  // namespace

FullDynamics::FullDynamics(const DynamicsOptions& options, const PinholeCamera& camera,
                           const ClassPolicies& policies)
    : options_(options), camera_(camera), policies_(policies), judge_(camera, options.motion) {}

DynamicMask FullDynamics::Process(const RgbdFrame& frame, const Segmentation& segmentation,
                                  const LatticeStep& step) {
  const std::int64_t last_stamp_ns = state_.last ? state_.last->stamp_ns : frame.stamp_ns;
  FollowInstances(frame, segmentation);
  const MotionVerdict verdict =
      judge_.Process({step.frame, step.flow, InstancePrior(), frame.id.value}, state_);
  JudgeInstances(verdict, NanosecondsToSeconds(frame.stamp_ns - last_stamp_ns));

  DynamicMask result;
  result.mask = MaskOf(verdict, step.frame, frame, segmentation);
  result.unmapped = result.mask.clone();
  for (const InstanceTrack& track : tracks_.tracks) {
    const Instance& instance = track.instance;
    result.followed.push_back({instance.id, instance.class_id, instance.score, instance.mask});
    AddDilated(instance.mask, options_.dilation_px, result.unmapped);
  }
  // Whole detections too, refined away or not: maps would show them with their class.
  for (const Instance& instance : segmentation.instances) {
    if (policies_.MayMove(instance.class_id)) result.unmapped.setTo(255, instance.mask);
  }
  result.static_probability = StaticProbabilityOf(verdict);
  if (verdict.camera_motion.is_measured) {
    result.camera_motion =
        FrameMotion{last_stamp_ns, verdict.camera_motion.last_from_current.Inverse()};
  }
  result.flow = DrawnFlow(verdict, step, judge_.lattice().cells(), camera_);
  result.masked_share = ShareOf(result.mask);
  return result;
}

/// Refines the instances that may move and brings their tracks up to this frame.
void FullDynamics::FollowInstances(const RgbdFrame& frame, const Segmentation& segmentation) {
  std::vector<Instance> movers;
  for (const Instance& instance : segmentation.instances) {
    if (!policies_.MayMove(instance.class_id)) continue;
    RefinedMask refined = RefineMask(instance.mask, frame.depth_m, options_.refinement);
    if (refined.verdict == MaskVerdict::kDistrusted) continue;
    Instance mover = instance;
    mover.mask = std::move(refined.mask);
    mover.box = cv::boundingRect(mover.mask);
    if (!mover.box.empty()) movers.push_back(std::move(mover));
  }
  if (frame.stamp_ns <= tracks_.stamp_ns) tracks_ = {0, tracks_.next_id, {}};  // a new recording
  tracks_ = TrackInstances(tracks_, {movers, frame.depth_m, frame.stamp_ns}, options_.tracker);
}

double FullDynamics::MotionOf(const InstanceTrack& track) const {
  if (policies_.Of(track.instance.class_id) == ClassPolicy::kAlwaysDynamic) {
    return options_.instance_motion.limit;
  }
  const auto known = motions_.find(track.instance.id);
  return known == motions_.end() ? options_.instance_motion.presumed_log_odds : known->second;
}

/// Log-odds per cell of what is believed to move as a whole. One that stands still brings nothing
/// along: its cells are judged as any others.
cv::Mat FullDynamics::InstancePrior() const {
  const IdealLattice& cells = judge_.lattice().cells();
  cv::Mat prior(cells.size(), CV_32FC1, cv::Scalar(0));
  for (const InstanceTrack& track : tracks_.tracks) {
    if (MotionOf(track) <= 0) continue;
    prior.setTo(options_.instance_motion.limit, cells.SampleNearest(track.instance.mask));
  }
  return prior;
}

/// Learns from the flow which instances move; forgets those that are gone.
void FullDynamics::JudgeInstances(const MotionVerdict& verdict, double elapsed_s) {
  InstanceMotions now;
  for (const InstanceTrack& track : tracks_.tracks) {
    const cv::Mat cells = judge_.lattice().cells().SampleNearest(track.instance.mask);
    now[track.instance.id] =
        UpdateInstanceMotion(MotionOf(track), CountEvidence(verdict.flow_evidence, cells),
                             elapsed_s, options_.instance_motion);
  }
  motions_ = std::move(now);
}

/// Who stands still still breathes, gestures and leaves: useful, but worth less than furniture.
cv::Mat FullDynamics::StaticProbabilityOf(const MotionVerdict& verdict) const {
  cv::Mat probability = judge_.lattice().cells().ToImage(StaticProbability(verdict.belief));
  const double most = 255 * options_.instance_motion.standing_weight;
  for (const InstanceTrack& track : tracks_.tracks) {
    if (MotionOf(track) > 0) continue;
    cv::Mat at_most;
    cv::min(probability, most, at_most);
    at_most.copyTo(probability, track.instance.mask);
  }
  return probability;
}

cv::Mat FullDynamics::MaskOf(const MotionVerdict& verdict, const LatticeFrame& lattice_frame,
                             const RgbdFrame& frame, const Segmentation& segmentation) const {
  const IdealLattice& cells = judge_.lattice().cells();
  cv::Mat moving = UpsampleMask(cells, verdict.belief > options_.motion.belief.verdict,
                                lattice_frame.depth_m, frame.depth_m);
  for (const InstanceTrack& track : tracks_.tracks) {
    if (MotionOf(track) > 0) moving.setTo(255, track.instance.mask);
  }
  for (const Instance& instance : segmentation.instances) {
    if (policies_.Of(instance.class_id) == ClassPolicy::kNeverDynamic) {
      moving.setTo(0, instance.mask);
    }
  }
  cv::Mat mask = cv::Mat::zeros(moving.size(), CV_8UC1);
  AddDilated(moving, options_.motion.dilation_px, mask);
  return mask;
}

}  // namespace ofm
