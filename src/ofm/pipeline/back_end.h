// What happens behind tracking: keyframes go into the map and into the semantic map.
#pragma once

#include <map>
#include <span>

#include "ofm/base/timing.h"
#include "ofm/pipeline/background_adjustment.h"
#include "ofm/pipeline/dense_upkeep.h"
#include "ofm/pipeline/run_outcome.h"
#include "ofm/pipeline/slam.h"

namespace ofm {

/// A keyframe on its way to mapping.
struct KeyframeJob {
  KeyframeCandidate candidate;
  std::vector<Sighting> sightings;
  DenseJob dense;  ///< ids are set by the back end
};

/// The images and labels of a frame as the semantic map takes them, in the frame's own camera.
LabelledFrame MakeLabelledFrame(const PreparedFrame& prepared,
                                const RigidTransform& depth_from_color = {});

/// The images and instances of a frame as objects are made of them.
InstanceFrame MakeInstanceFrame(const PreparedFrame& prepared);

/// Which object each instance of each key frame became.
InstanceObjects FindInstanceObjects(std::span<const SceneObject> objects);

/// When the whole map is adjusted after a loop, and the dense maps are brought up to the map.
enum class LoopAdjustment {
  kAtOnce,        ///< before the next keyframe: reproducible
  kInBackground,  ///< while further keyframes come; a newer loop cancels it
};

/// Runs the mapping, loop and dense stages of `slam` for one keyframe at a time. Serves one thread.
/// Once one of the others has thrown, only Finish may follow.
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
  /// Hands the keyframes inserted since to the dense maps, with their poses in `map`, the latest
  /// snapshot: what tracking does not wait for.
  virtual void UpdateDenseMaps(std::shared_ptr<const MapSnapshot> map);
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
  void FinishMaps(RunOutcome& outcome);
  void TakeAdjustment(std::optional<FinishedAdjustment> finished);

  Slam& slam_;
  LoopAdjustment adjustment_;
  BackgroundAdjustment background_;
  DenseUpkeep dense_;
  std::vector<KeyframeId> unseen_;  // keyframes in which no loop was looked for yet
  std::vector<LoopRecord> loops_;
  std::vector<DenseJob> dense_jobs_;  // of keyframes that the dense maps do not have yet
  StageTimes times_;
  std::map<FrameId, KeyframeId> keyframe_of_frame_;
  bool is_whole_ = true;  // no change of the map was cut short
};

}  // namespace ofm
