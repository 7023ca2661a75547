// Mode `full`: what moves by flow, depth, instances and what was believed before.
#pragma once

#include "ofm/camera/rgbd_frame.h"
#include "ofm/dynamics/class_policy.h"
#include "ofm/dynamics/dynamic_mask.h"
#include "ofm/dynamics/dynamics_options.h"
#include "ofm/dynamics/instance_motion.h"
#include "ofm/dynamics/instance_tracker.h"
#include "ofm/dynamics/motion_judge.h"
#include "ofm/perception/lattice_flow.h"
#include "ofm/perception/segmentation.h"

namespace ofm {

/// Instances that may move are refined by depth, followed over time and judged by their motion;
/// their cells start from what is believed of the instance. Everything else is judged cell by cell.
/// Frames come in increasing order of time. One object serves one thread.
class FullDynamics {
 public:
  FullDynamics(const DynamicsOptions& options, const PinholeCamera& camera,
               const ClassPolicies& policies);

  /// `step` is that of the frame.
  DynamicMask Process(const RgbdFrame& frame, const Segmentation& segmentation,
                      const LatticeStep& step);

 private:
  void FollowInstances(const RgbdFrame& frame, const Segmentation& segmentation);
  cv::Mat InstancePrior() const;
  void JudgeInstances(const MotionVerdict& verdict, double elapsed_s);
  cv::Mat MaskOf(const MotionVerdict& verdict, const LatticeFrame& lattice_frame,
                 const RgbdFrame& frame, const Segmentation& segmentation) const;
  cv::Mat StaticProbabilityOf(const MotionVerdict& verdict) const;
  double MotionOf(const InstanceTrack& track) const;

  DynamicsOptions options_;
  PinholeCamera camera_;
  ClassPolicies policies_;
  MotionJudge judge_;
  MotionState state_;
  InstanceTracks tracks_;    // of instances that may move
  InstanceMotions motions_;  // by track
};

}  // namespace ofm
