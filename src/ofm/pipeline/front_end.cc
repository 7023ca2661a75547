#include "ofm/pipeline/front_end.h"

#include <cmath>

#include "ofm/features/exclusion.h"

namespace ofm {
namespace {

/// Patches are for alignment alone.
OrbOptions ExtractorOptions(const SlamOptions& options) {
  OrbOptions features = options.features;
  features.patches = options.tracking.alignment.enabled;
  return features;
}

/// As many for each visible pixel as where nothing is masked: what is seen of the static scene
/// between people must be used better.
int WantedFeatures(const OrbOptions& options, double masked_share, double most_times) {
  const double visible_share = 1 - masked_share;
  const double times = visible_share * most_times > 1 ? 1 / visible_share : most_times;
  return static_cast<int>(std::lround(times * options.count));
}

}  // namespace

FrontEnd::FrontEnd(const PinholeCamera& camera, const SlamOptions& options,
                   std::unique_ptr<Segmenter> segmenter)
    : camera_(camera),
      mode_(options.dynamics.mode),
      point_flow_(options.perception.flow),
      lattice_flow_(camera, options.dynamics.motion.lattice),
      segmentation_(std::move(segmenter), options.perception.schedule,
                    lattice_flow_.lattice().cells()),
      dynamics_(options.dynamics, camera, segmentation_.class_names()),
      extractor_(ExtractorOptions(options)),
      crowded_features_(options.dynamics.crowded_features) {}

PreparedFrame FrontEnd::Process(RgbdFrame frame, StageTimes& times) {
  return Perceive(Flow(std::move(frame), times), times);
}

FlowedFrame FrontEnd::Flow(RgbdFrame frame, StageTimes& times) {
  FlowedFrame flowed{std::move(frame), {}};
  if (mode_ == DynamicsMode::kFull || segmentation_.NeedsFlow()) {
    ScopedStageTimer timer(times, "dense_flow");
    flowed.step = lattice_flow_.Process(flowed.frame);
  }
  return flowed;
}

PreparedFrame FrontEnd::Perceive(FlowedFrame flowed, StageTimes& times) {
  PreparedFrame prepared;
  prepared.frame = std::move(flowed.frame);
  const LatticeStep& step = flowed.step;
  {
    ScopedStageTimer timer(times, "segmentation");
    prepared.segmentation = segmentation_.Process(prepared.frame, step);
  }
  FlowResult flow;
  if (mode_ == DynamicsMode::kPaper) {
    ScopedStageTimer timer(times, "optical_flow");
    flow = point_flow_.Advance(prepared.frame.gray, last_points_);
  }
  if (mode_ != DynamicsMode::kOff) {
    ScopedStageTimer timer(times, "dynamics");
    prepared.dynamic = dynamics_.Process({prepared.frame, prepared.segmentation, flow, step});
  }
  ScopedStageTimer timer(times, "features");
  Features features = Extract(prepared);
  prepared.features = MakeFrameFeatures(std::move(features), prepared.frame.depth_m, camera_,
                                        prepared.dynamic.static_probability);
  return prepared;
}

/// The paper takes key points as if nothing moved and drops those that do; its optical flow starts
/// from all of them. Mode `full` takes as many as it wants from what stands still.
Features FrontEnd::Extract(const PreparedFrame& prepared) {
  const cv::Mat& gray = prepared.frame.gray;
  const DynamicMask& dynamic = prepared.dynamic;
  if (mode_ != DynamicsMode::kPaper) {
    return extractor_.Extract(
        gray, dynamic.mask,
        WantedFeatures(extractor_.options(), dynamic.masked_share, crowded_features_));
  }
  Features features = extractor_.Extract(gray);
  last_points_.clear();
  for (const Keypoint& keypoint : features.keypoints) last_points_.push_back(keypoint.pixel);
  EraseExcluded(dynamic.mask, features);
  return features;
}

}  // namespace ofm
