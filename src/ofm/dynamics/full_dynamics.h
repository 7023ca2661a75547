// Mode `full`: what moves by flow, depth, instances and what was believed before.
#pragma once

#include <string>
#include <vector>

#include "ofm/camera/rgbd_frame.h"
#include "ofm/dynamics/dynamic_mask.h"
#include "ofm/dynamics/dynamics_options.h"
#include "ofm/dynamics/motion_judge.h"
#include "ofm/perception/segmentation.h"

namespace ofm {

/// Frames come in increasing order of time. One object serves one thread.
class FullDynamics {
 public:
  FullDynamics(const DynamicsOptions& options, const PinholeCamera& camera,
               std::vector<ClassId> dynamic_classes);

  DynamicMask Process(const RgbdFrame& frame, const Segmentation& segmentation);

 private:
  cv::Mat InstancePrior(const Segmentation& segmentation) const;

  DynamicsOptions options_;
  std::vector<ClassId> dynamic_classes_;
  MotionJudge judge_;
  MotionState state_;
};

}  // namespace ofm
