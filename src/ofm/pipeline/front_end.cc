#include "ofm/pipeline/front_end.h"

#include <cmath>

namespace ofm {
namespace {

/// What is seen of the static scene between people must be used better.
OrbOptions CrowdedOptions(const SlamOptions& options) {
  OrbOptions features = options.features;
  features.count =
      static_cast<int>(std::lround(features.count * options.dynamics.crowded_features));
  return features;
}

}  // namespace

FrontEnd::FrontEnd(const PinholeCamera& camera, const SlamOptions& options,
                   std::unique_ptr<Segmenter> segmenter)
    : camera_(camera),
      flow_(options.perception.flow),
      mode_(options.dynamics.mode),
      segmentation_(std::move(segmenter), options.perception.schedule, flow_),
      dynamics_(options.dynamics, camera, segmentation_.class_names()),
      extractor_(options.features),
      crowded_extractor_(CrowdedOptions(options)),
      crowded_share_(options.dynamics.crowded_share) {}

PreparedFrame FrontEnd::Process(RgbdFrame frame, StageTimes& times) {
  PreparedFrame prepared;
  prepared.frame = std::move(frame);
  FlowPyramid pyramid;
  if (mode_ == DynamicsMode::kPaper || segmentation_.NeedsPyramid()) {
    ScopedStageTimer timer(times, "image_pyramid");
    pyramid = BuildFlowPyramid(prepared.frame.gray, flow_);
  }
  {
    ScopedStageTimer timer(times, "segmentation");
    prepared.segmentation = segmentation_.Process(prepared.frame, pyramid);
  }
  if (mode_ != DynamicsMode::kOff) {
    FlowResult flow;
    if (mode_ == DynamicsMode::kPaper) {
      ScopedStageTimer timer(times, "optical_flow");
      if (last_pyramid_.size == pyramid.size) {
        flow = TrackPoints(last_pyramid_, pyramid, last_points_, flow_);
      }
      last_pyramid_ = std::move(pyramid);
    }
    ScopedStageTimer timer(times, "dynamics");
    prepared.dynamic = dynamics_.Process({prepared.frame, prepared.segmentation, flow});
  }
  ScopedStageTimer timer(times, "features");
  OrbExtractor& extractor =
      prepared.dynamic.masked_share > crowded_share_ ? crowded_extractor_ : extractor_;
  Features features = extractor.Extract(prepared.frame.gray, prepared.dynamic.mask);
  last_points_.clear();
  for (const Keypoint& keypoint : features.keypoints) last_points_.push_back(keypoint.pixel);
  prepared.features = MakeFrameFeatures(std::move(features), prepared.frame.depth_m, camera_,
                                        prepared.dynamic.static_probability);
  return prepared;
}

}  // namespace ofm
