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

/// Optical flow, segmentation, dynamic mask and features, one after the other. Serves one thread.
class FrontEnd {
 public:
  FrontEnd(const PinholeCamera& camera, const SlamOptions& options,
           std::unique_ptr<Segmenter> segmenter);

  /// Frames come in increasing order of time. Adds the time of each part to `times`.
  PreparedFrame Process(RgbdFrame frame, StageTimes& times);

  const std::vector<std::string>& class_names() const { return segmentation_.class_names(); }
  SegmentationStatistics segmentation_statistics() const { return segmentation_.statistics(); }

 private:
  PinholeCamera camera_;
  DynamicsMode mode_;
  OpticalFlow point_flow_;    // mode paper
  LatticeFlow lattice_flow_;  // mode full, and where masks are carried
  SegmentationStage segmentation_;
  DynamicsStage dynamics_;
  OrbExtractor extractor_, crowded_extractor_;
  double crowded_share_;
  std::vector<Eigen::Vector2f> last_points_;  // key points of the last frame [px]
};

}  // namespace ofm
