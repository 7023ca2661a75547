#include "ofm/pipeline/back_end.h"

#include "ofm/perception/label_image.h"

namespace ofm {

LabelledFrame MakeLabelledFrame(const PreparedFrame& prepared) {
  LabelledFrame labelled;
  const LabelImage labels = ComposeLabelImage(prepared.segmentation, prepared.frame.color.size());
  labelled.color = prepared.frame.color;
  labelled.depth_m = prepared.frame.depth_m;
  labelled.class_ids = labels.labels;
  labelled.confidence = labels.confidence;
  labelled.dynamic_mask =
      prepared.dynamic.unmapped.empty() ? prepared.dynamic.mask : prepared.dynamic.unmapped;
  return labelled;
}

std::shared_ptr<const MapSnapshot> BackEnd::Insert(KeyframeJob job) {
  KeyframeId id;
  is_whole_ = false;
  {
    ScopedStageTimer timer(times_, "keyframe_insertion");
    id = slam_.mapper().Insert(job.candidate, job.sightings);
  }
  is_whole_ = true;
  keyframe_of_frame_[job.candidate.frame_id] = id;
  if (!job.labelled.depth_m.empty()) {
    ScopedStageTimer timer(times_, "semantic_cloud");
    job.labelled.id = id;
    slam_.semantic_mapper().AddKeyframe(job.labelled);
  }
  return slam_.mapper().Snapshot();
}

std::shared_ptr<const MapSnapshot> BackEnd::Refine(std::stop_token stop) {
  ScopedStageTimer timer(times_, "mapping");
  is_whole_ = false;
  slam_.mapper().Refine(stop);
  is_whole_ = true;
  return slam_.mapper().Snapshot();
}

void BackEnd::Finish(RunOutcome& outcome) {
  outcome.map = slam_.mapper().Snapshot();
  outcome.map_is_whole = is_whole_;
  // A loaded map to which nothing was added stays as it is.
  if (slam_.options().final_adjustment && is_whole_ && !keyframe_of_frame_.empty()) {
    ScopedStageTimer timer(times_, "final_adjustment");
    slam_.mapper().AdjustAll();
    outcome.map = slam_.mapper().Snapshot();
  }
  if (!slam_.options().build_semantic_map || slam_.options().localize_only) return;
  ScopedStageTimer timer(times_, "semantic_map");
  std::map<KeyframeId, RigidTransform> poses;
  for (const auto& [frame, keyframe] : keyframe_of_frame_) {
    const auto pose = outcome.map->FindKeyframePose(keyframe);
    if (pose) poses[keyframe] = pose->Inverse();
  }
  outcome.semantic_map = slam_.semantic_mapper().Build(poses);
}

}  // namespace ofm
