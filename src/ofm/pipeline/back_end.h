// What happens behind tracking: keyframes go into the map and into the semantic map.
#pragma once

#include <map>
#include <span>

#include "ofm/base/timing.h"
#include "ofm/pipeline/background_adjustment.h"
#include "ofm/pipeline/octree_upkeep.h"
#include "ofm/pipeline/run_outcome.h"
#include "ofm/pipeline/slam.h"

namespace ofm {

/// A keyframe on its way to mapping.
struct KeyframeJob {
  KeyframeCandidate candidate;
  std::vector<Sighting> sightings;
  LabelledFrame labelled;  ///< its id is set by the back end; no images where no map is wanted
  std::vector<LabelledFrame> views;  ///< frames since the last keyframe, for the semantic map
  InstanceFrame instances;           ///< the same, where no objects are wanted
};

/// The images and labels of a frame as the semantic map takes them, in the frame's own camera.
LabelledFrame MakeLabelledFrame(const PreparedFrame& prepared,
                                const RigidTransform& depth_from_color = {});

/// The images and instances of a frame as objects are made of them.
InstanceFrame MakeInstanceFrame(const PreparedFrame& prepared);

/// Which object each instance of each key frame became.
InstanceObjects FindInstanceObjects(std::span<const SceneObject> objects);

/// When the whole map is adjusted after a loop, and the octree brought up to the map.
enum class LoopAdjustment {
  kAtOnce,        ///< before the next keyframe: reproducible
  kInBackground,  ///< while further keyframes come; a newer loop cancels it
};

/// Runs the mapping, loop and dense stages of `slam` for one keyframe at a time. Serves one thread.
/// Once Insert or Refine has thrown, only Finish may follow.
class BackEnd {
 public:
  explicit BackEnd(Slam& slam, LoopAdjustment adjustment = LoopAdjustment::kAtOnce);
  virtual ~BackEnd() = default;
  BackEnd(const BackEnd&) = delete;
  BackEnd& operator=(const BackEnd&) = delete;

  /// Puts the keyframe into the map; gives the snapshot that tracking can use at once.
  virtual std::shared_ptr<const MapSnapshot> Insert(KeyframeJob job);
  /// Everything that may take its time, loops included; gives the refined snapshot.
  virtual std::shared_ptr<const MapSnapshot> Refine(std::stop_token stop = {});
  /// Final adjustment, the semantic map and the objects (without tracks), from the poses that then
  /// are known. `outcome` has a map even where this throws. A map whose last change was cut short
  /// by an error is not adjusted.
  virtual void Finish(RunOutcome& outcome);

  /// Keyframe made of a frame, for the trajectory; by frame id.
  const std::map<FrameId, KeyframeId>& keyframe_of_frame() const { return keyframe_of_frame_; }
  const StageTimes& times() const { return times_; }

 private:
  std::shared_ptr<const MapSnapshot> CloseLoops(std::shared_ptr<const MapSnapshot> map);
  void Apply(const LoopClosure& closure, const MapSnapshot& map);
  void AdjustAfterLoop();
  KeyframePoseMap KeyframePoses(const MapSnapshot& map, SubmapId submap) const;
  SubmapId ResultSubmap(const MapSnapshot& map) const;
  void BoundClouds(const MapSnapshot& map);
  void KeepUpOctree(const MapSnapshot& map);
  void FinishMaps(RunOutcome& outcome);
  void TakeAdjustment(std::optional<FinishedAdjustment> finished);

  Slam& slam_;
  LoopAdjustment adjustment_;
  BackgroundAdjustment background_;
  OctreeUpkeep octree_;
  std::vector<KeyframeId> unseen_;  // keyframes in which no loop was looked for yet
  std::vector<LoopRecord> loops_;
  StageTimes times_;
  std::map<FrameId, KeyframeId> keyframe_of_frame_;
  bool is_whole_ = true;  // no change of the map was cut short
};

}  // namespace ofm
