// What a run leaves behind.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ofm/base/timing.h"
#include "ofm/dense/semantic_mapper.h"
#include "ofm/geometry/trajectory.h"
#include "ofm/loop/loop_closer.h"
#include "ofm/map/map.h"
#include "ofm/objects/scene_object.h"
#include "ofm/pipeline/frame_record.h"

namespace ofm {

struct RunCounts {
  std::size_t frames = 0;          ///< that the system was given
  std::size_t frames_tracked = 0;  ///< that have a pose
  std::size_t frames_reckoned =
      0;                           ///< of these, without any landmark: by the camera's motion alone
  std::size_t frames_dropped = 0;  ///< that came too early (real time only)
  std::size_t keyframes_made = 0, keyframes = 0, landmarks = 0;
  std::size_t losses = 0;         ///< times that tracking was lost
  std::size_t submaps_begun = 0;  ///< of these, after which a new sub-map was begun
  double mean_masked_share = 0;   ///< of the pixels, 0 to 1
};

/// A loop as it was closed.
struct LoopRecord {
  std::int64_t keyframe_stamp_ns = 0, place_stamp_ns = 0;
  RigidTransform place_from_keyframe;  ///< of the two cameras, as measured
  std::size_t matches = 0;             ///< landmarks of the place that the keyframe shows
  double drift_m = 0, drift_rad = 0;   ///< by which the keyframe was off; 0 for a join
  int landmarks_fused = 0;
  std::optional<SubmapJoin> join;  ///< where it joined two sub-maps
};

/// A sub-map whose place in the world of the results was never found.
struct UnjoinedSubmap {
  SubmapId id;
  std::size_t keyframes = 0;
  Trajectory trajectory;  ///< of its frames, in a world of its own
};

struct RunOutcome {
  /// Whose world all that follows is in: of the map that was loaded, or the largest.
  SubmapId submap;
  Trajectory trajectory;       ///< world_from_camera of every tracked frame, after optimisation
  Trajectory live_trajectory;  ///< what was known at the time of each frame
  Trajectory keyframe_trajectory;
  std::vector<UnjoinedSubmap> unjoined;
  std::shared_ptr<const MapSnapshot> map;
  bool map_is_whole = true;  ///< false where an error cut a change of the map short
  std::optional<SemanticMap> semantic_map;
  std::optional<ObjectInventory> objects;  ///< where a segmenter knows classes
  std::vector<std::string> class_names;
  std::vector<FrameRecord> frames;  ///< of every frame, in order of time
  StageTimes times;
  RunCounts counts;
  LoopCounts loop_counts;
  std::vector<LoopRecord> loops;
  double wall_s = 0, process_cpu_s = 0;
  std::string error;  ///< why the run ended before its source did; empty where it did not
};

}  // namespace ofm
