// From a frame to features on what stands still.
#pragma once

#include <memory>

#include "ofm/base/timing.h"
#include "ofm/dynamics/dynamics_stage.h"
#include "ofm/perception/optical_flow.h"
#include "ofm/perception/segmentation_stage.h"
#include "ofm/pipeline/options.h"

namespace ofm {

/// A frame with what the front end found in it. A value: shared by the stages behind.
struct PreparedFrame {
  RgbdFrame frame;
  Segmentation segmentation;
  DynamicMask dynamic;
  std::shared_ptr<const FrameFeatures> features;
};

/// A frame with the flow that led to it. A value.
struct FlowedFrame {
  RgbdFrame frame;
  LatticeStep step;  ///< empty where nothing needs it
};

/// Optical flow, segmentation, dynamic mask and features, one after the other. Serves one thread,
/// or two: one that calls Flow, one that calls Perceive.
class FrontEnd {
 public:
  FrontEnd(const PinholeCamera& camera, const SlamOptions& options,
           std::unique_ptr<Segmenter> segmenter);

  /// Both of the parts below. Frames come in increasing order of time. Adds the time of each stage
  /// to `times`.
  PreparedFrame Process(RgbdFrame frame, StageTimes& times);

  /// Dense flow: needs the images alone, and so can be ahead of the rest.
  FlowedFrame Flow(RgbdFrame frame, StageTimes& times);
  /// Everything else, in the order of Flow's frames.
  PreparedFrame Perceive(FlowedFrame flowed, StageTimes& times);

  const std::vector<std::string>& class_names() const { return segmentation_.class_names(); }
  SegmentationStatistics segmentation_statistics() const { return segmentation_.statistics(); }

 private:
  Features Extract(const PreparedFrame& prepared);

  PinholeCamera camera_;
  DynamicsMode mode_;
  OpticalFlow point_flow_;    // mode paper
  LatticeFlow lattice_flow_;  // mode full, and where masks are carried; Flow's own
  SegmentationStage segmentation_;
  DynamicsStage dynamics_;
  OrbExtractor extractor_;
  double crowded_features_;
  std::vector<Eigen::Vector2f> last_points_;  // mode paper: all of the last frame's [px]
};

}  // namespace ofm
