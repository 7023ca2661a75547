// Decides what in a frame must not be trusted.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ofm/base/ids.h"
#include "ofm/camera/pinhole_camera.h"
#include "ofm/camera/rgbd_frame.h"
#include "ofm/dynamics/dynamic_mask.h"
#include "ofm/dynamics/dynamics_options.h"
#include "ofm/dynamics/full_dynamics.h"
#include "ofm/perception/optical_flow.h"
#include "ofm/perception/segmentation.h"

namespace ofm {

/// All of one frame.
struct DynamicsInput {
  const RgbdFrame& frame;
  const Segmentation& segmentation;
  const FlowResult& flow;   ///< of the last frame's key points into this one; mode `paper`
  const LatticeStep& step;  ///< of the frame; mode `full`
};

/// Modes `off`, `paper` (the paper's Algorithm 1 and its union with the masks of people; a function
/// of its input alone) and `full` (see FullDynamics). One object serves one thread.
class DynamicsStage {
 public:
  /// `class_names` are the segmenter's. Throws Error for a dynamic class that is not among them,
  /// unless there are none at all.
  DynamicsStage(const DynamicsOptions& options, const PinholeCamera& camera,
                const std::vector<std::string>& class_names);

  /// The union of the dynamic classes' masks, dilated, and discs around the points that flow finds
  /// off their epipolar lines. The fundamental matrix is that of the points off the masks; where it
  /// cannot be had or believed, flow gives no verdict.
  DynamicMask Process(const DynamicsInput& input);

 private:
  void AddInstances(const Segmentation& segmentation, cv::Mat& mask) const;
  void FindMovingPoints(const FlowResult& flow, DynamicMask& result) const;

  DynamicsOptions options_;
  PinholeCamera camera_;
  ClassPolicies policies_;
  std::optional<FullDynamics> full_;
};

}  // namespace ofm
