// Clouds, objects and the octree, kept up with the map while a run goes on.
#pragma once

#include <exception>
#include <memory>
#include <thread>
#include <vector>

#include "ofm/base/bounded_queue.h"
#include "ofm/base/latest.h"
#include "ofm/base/timing.h"
#include "ofm/dense/semantic_mapper.h"
#include "ofm/map/map.h"
#include "ofm/objects/object_mapper.h"
#include "ofm/pipeline/octree_upkeep.h"

namespace ofm {

/// What a key frame has for the dense maps.
struct DenseJob {
  LabelledFrame labelled;            ///< no images where no semantic map is wanted
  std::vector<LabelledFrame> views;  ///< frames since the last key frame
  InstanceFrame instances;           ///< no images where no objects are wanted
};

/// Key frames that are new, and the map with them.
struct DenseUpdate {
  std::vector<DenseJob> jobs;
  std::shared_ptr<const MapSnapshot> map;
  /// Of all key frames of which there are results; empty where the octree is made at the end alone.
  KeyframePoseMap world_from_camera;
};

enum class UpkeepThread {
  kCaller,      ///< at once: reproducible
  kBackground,  ///< in a thread of its own, which takes the time that others leave
};

/// Feeds the mappers, which must outlive it, and brings an octree up to them. Serves one thread;
/// nobody else may use the mappers before Finish.
class DenseUpkeep {
 public:
  DenseUpkeep(SemanticMapper& semantic_mapper, ObjectMapper& object_mapper, UpkeepThread thread);
  DenseUpkeep(const DenseUpkeep&) = delete;
  DenseUpkeep& operator=(const DenseUpkeep&) = delete;

  /// Throws what went wrong, in the background that of an earlier update: nothing is done after
  /// that. In the background, views are left out while much waits, and it waits itself only where
  /// very much does.
  void Update(DenseUpdate update);

  /// Ends the thread, and does what waits. Gives what went wrong and was not thrown.
  std::exception_ptr Finish();
  /// Of exactly these poses: what SemanticMapper::Build has. After Finish.
  SemanticOctree FinishOctree(const KeyframePoseMap& world_from_camera);

  /// Of "semantic_cloud", "object_observation" and "octree_upkeep"; after Finish.
  const StageTimes& times() const { return times_; }

 private:
  void Drain(const std::stop_token& stop);
  void Add(const DenseUpdate& update);
  void KeepUpOctree(const DenseUpdate& update);
  void BoundClouds(const MapSnapshot& map);

  SemanticMapper& semantic_mapper_;  // the thread's while there is one
  ObjectMapper& object_mapper_;      // likewise
  OctreeUpkeep octree_;              // likewise
  StageTimes times_;                 // likewise
  UpkeepThread where_;
  std::size_t views_left_out_ = 0;
  BoundedQueue<DenseUpdate> updates_;
  Latest<std::exception_ptr> error_;
  std::jthread thread_;  // last: ends before what it uses
};

}  // namespace ofm
