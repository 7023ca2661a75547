#include "ofm/loop/submap_join.h"

#include "ofm/loop/loop_duplicates.h"

namespace ofm {

MapCorrection ComputeSubmapJoin(const MapSnapshot& map, const VerifiedLoop& loop,
                                const SubmapJoin& join, const MeasurementModel& model,
                                const LoopOptions& options) {
  const Keyframe& keyframe = *map.keyframes.Find(loop.keyframe);
  const RigidTransform place_world_from_keyframe_world =
      loop.camera_from_world.Inverse() * keyframe.camera_from_world;
  const RigidTransform from_world_from_into_world = keyframe.submap == join.from
                                                        ? place_world_from_keyframe_world.Inverse()
                                                        : place_world_from_keyframe_world;
  MapCorrection correction;
  correction.join = join;
  map.keyframes.ForEach([&](const Keyframe& moved) {
    const RigidTransform& before = moved.camera_from_world;
    correction.keyframes[moved.id] = {
        before, moved.submap == join.from ? before * from_world_from_into_world : before};
  });
  AddDuplicates(map, loop, model, options, correction);
  return correction;
}

}  // namespace ofm
