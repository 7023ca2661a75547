#include "ofm/pipeline/back_end.h"

#include <utility>

#include "ofm/map/submap.h"
#include "ofm/perception/label_image.h"
#include "ofm/pipeline/keep_error.h"

namespace ofm {

LabelledFrame MakeLabelledFrame(const PreparedFrame& prepared,
                                const RigidTransform& depth_from_color) {
  LabelledFrame labelled;
  labelled.stamp_ns = prepared.frame.stamp_ns;
  labelled.keyframe_from_depth = depth_from_color.Inverse();
  const LabelImage labels = ComposeLabelImage(prepared.segmentation, prepared.frame.color.size());
  labelled.color = prepared.frame.color;
  labelled.depth_m = prepared.frame.depth_m;
  labelled.class_ids = labels.labels;
  labelled.confidence = labels.confidence;
  labelled.instances = labels.instances;
  labelled.dynamic_mask =
      prepared.dynamic.unmapped.empty() ? prepared.dynamic.mask : prepared.dynamic.unmapped;
  return labelled;
}

InstanceFrame MakeInstanceFrame(const PreparedFrame& prepared) {
  InstanceFrame frame;
  frame.stamp_ns = prepared.frame.stamp_ns;
  frame.color = prepared.frame.color;
  frame.depth_m = prepared.frame.depth_m;
  frame.dynamic_mask = prepared.dynamic.mask;
  frame.instances = prepared.segmentation.instances;
  return frame;
}

InstanceObjects FindInstanceObjects(std::span<const SceneObject> objects) {
  InstanceObjects found;
  for (const SceneObject& object : objects) {
    for (const ObjectSighting& sighting : object.sightings) {
      std::vector<std::uint16_t>& of_instance = found[sighting.keyframe];
      if (of_instance.size() <= sighting.instance) {
        of_instance.resize(sighting.instance + 1, kNoInstance);
      }
      of_instance[sighting.instance] = static_cast<std::uint16_t>(object.id.value);
    }
  }
  return found;
}

BackEnd::BackEnd(Slam& slam, LoopAdjustment adjustment)
    : slam_(slam),
      adjustment_(adjustment),
      background_(slam.model(), slam.options().mapping.final_bundle),
      dense_(slam.semantic_mapper(), slam.object_mapper(),
             adjustment == LoopAdjustment::kAtOnce ? UpkeepThread::kCaller
                                                   : UpkeepThread::kBackground) {}

std::shared_ptr<const MapSnapshot> BackEnd::Insert(KeyframeJob job) {
  KeyframeId id;
  is_whole_ = false;
  {
    ScopedStageTimer timer(times_, "keyframe_insertion");
    id = slam_.mapper().Insert(job.candidate, job.sightings);
  }
  is_whole_ = true;
  keyframe_of_frame_[job.candidate.frame_id] = id;
  unseen_.push_back(id);
  job.dense.labelled.id = id;
  job.dense.instances.id = id;
  dense_jobs_.push_back(std::move(job.dense));
  return slam_.mapper().Snapshot();
}

std::shared_ptr<const MapSnapshot> BackEnd::Refine(std::stop_token stop) {
  is_whole_ = false;
  TakeAdjustment(background_.Take());
  {
    ScopedStageTimer timer(times_, "mapping");
    slam_.mapper().Refine(stop);
  }
  std::shared_ptr<const MapSnapshot> map = slam_.mapper().Snapshot();
  if (slam_.options().loop.enabled) map = CloseLoops(std::move(map));
  is_whole_ = true;
  return map;
}

void BackEnd::UpdateDenseMaps(std::shared_ptr<const MapSnapshot> map) {
  const SlamOptions& options = slam_.options();
  const bool keeps_up_octree =
      options.build_semantic_map && options.dense.octree.upkeep == OctreeUpkeepTime::kWhileRunning;
  KeyframePoseMap poses;
  if (keeps_up_octree) poses = KeyframePoses(*map, ResultSubmap(*map));
  dense_.Update({std::exchange(dense_jobs_, {}), std::move(map), std::move(poses)});
}

/// Whose world the results are in.
SubmapId BackEnd::ResultSubmap(const MapSnapshot& map) const {
  return slam_.loaded_submap().valid() ? slam_.loaded_submap() : LargestSubmap(map);
}

/// Looks for loops at the keyframes that are new; gives the snapshot after them.
std::shared_ptr<const MapSnapshot> BackEnd::CloseLoops(std::shared_ptr<const MapSnapshot> map) {
  for (const KeyframeId id : unseen_) {
    std::optional<LoopClosure> closure;
    {
      ScopedStageTimer timer(times_, "loop_detection");
      closure = slam_.loop_closer().Process(*map, id);
    }
    if (!closure) continue;
    Apply(*closure, *map);
    if (slam_.options().loop.full_adjustment) AdjustAfterLoop();
    map = slam_.mapper().Snapshot();
  }
  unseen_.clear();
  return map;
}

void BackEnd::Apply(const LoopClosure& closure, const MapSnapshot& map) {
  ScopedStageTimer timer(times_, "loop_correction");
  const Keyframe& keyframe = *map.keyframes.Find(closure.loop.keyframe);
  const RigidTransform drift =
      closure.loop.camera_from_world * keyframe.camera_from_world.Inverse();
  LoopRecord record;
  record.keyframe_stamp_ns = keyframe.stamp_ns;
  record.place_stamp_ns = map.keyframes.Find(closure.loop.place)->stamp_ns;
  record.place_from_keyframe = closure.loop.place_from_keyframe;
  record.matches = closure.loop.matches.size();
  record.join = closure.correction.join;
  if (!record.join) {
    record.drift_m = drift.translation().norm();
    record.drift_rad = drift.RotationAngle();
  }
  record.landmarks_fused = slam_.mapper().Apply(closure.correction).landmarks_fused;
  loops_.push_back(record);
}

void BackEnd::AdjustAfterLoop() {
  std::shared_ptr<const MapSnapshot> map = slam_.mapper().Snapshot();
  background_.Start(std::move(map));
  if (adjustment_ == LoopAdjustment::kAtOnce) TakeAdjustment(background_.Wait());
}

void BackEnd::TakeAdjustment(std::optional<FinishedAdjustment> finished) {
  if (!finished) return;
  times_.Merge(finished->times);
  if (finished->correction) slam_.mapper().Apply(*finished->correction);
}

void BackEnd::Finish(RunOutcome& outcome) {
  outcome.map = slam_.mapper().Snapshot();
  outcome.submap = ResultSubmap(*outcome.map);
  outcome.loops = loops_;
  outcome.loop_counts = slam_.loop_closer().counts();
  outcome.map_is_whole = is_whole_;
  if (slam_.options().final_adjustment) {
    background_.Cancel();  // the final one does it all
  } else if (is_whole_) {
    TakeAdjustment(background_.Wait());
    outcome.map = slam_.mapper().Snapshot();
  }
  // A loaded map to which nothing was added stays as it is.
  if (slam_.options().final_adjustment && is_whole_ && !keyframe_of_frame_.empty()) {
    ScopedStageTimer timer(times_, "final_adjustment");
    slam_.mapper().AdjustAll();
    outcome.map = slam_.mapper().Snapshot();
  }
  if (!slam_.options().localize_only) FinishMaps(outcome);
}

/// Objects, and the semantic map whose points know them: of all that the mappers were given, also
/// where that ended by an error.
void BackEnd::FinishMaps(RunOutcome& outcome) {
  if (!dense_jobs_.empty()) {
    KeepError(outcome.error, [&] { UpdateDenseMaps(outcome.map); });
  }
  const std::exception_ptr error = dense_.Finish();
  times_.Merge(dense_.times());
  const KeyframePoseMap poses = KeyframePoses(*outcome.map, outcome.submap);
  if (slam_.makes_objects()) {
    ScopedStageTimer timer(times_, "objects");
    outcome.objects = slam_.object_mapper().Build(poses);
    outcome.objects->class_names = slam_.front_end().class_names();
  }
  if (slam_.options().build_semantic_map) {
    ScopedStageTimer timer(times_, "semantic_map");
    const InstanceObjects objects =
        outcome.objects ? FindInstanceObjects(outcome.objects->objects) : InstanceObjects();
    outcome.semantic_map =
        slam_.semantic_mapper().Complete(dense_.FinishOctree(poses), poses, objects);
  }
  if (error) std::rethrow_exception(error);
}

/// Those of this run whose place in the sub-map's world is known: world_from_camera.
KeyframePoseMap BackEnd::KeyframePoses(const MapSnapshot& map, SubmapId submap) const {
  KeyframePoseMap poses;
  for (const auto& [frame, keyframe] : keyframe_of_frame_) {
    const auto pose = map.FindKeyframePose(keyframe);
    if (pose && map.FindSubmap(keyframe) == submap) poses[keyframe] = pose->Inverse();
  }
  return poses;
}

}  // namespace ofm
