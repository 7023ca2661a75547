// The octree kept up with the map while a run goes on.
#pragma once

#include <stop_token>
#include <thread>

#include "ofm/base/bounded_queue.h"
#include "ofm/base/timing.h"
#include "ofm/dense/octree_integrator.h"

namespace ofm {

/// Where key frames are integrated.
enum class UpkeepThread {
  kCaller,      ///< at once: reproducible
  kBackground,  ///< in a thread of its own; what is newer replaces what waits
};

/// Brings an octree up to clouds and poses. Serves one thread, which waits in Finish alone.
class OctreeUpkeep {
 public:
  OctreeUpkeep(const DenseOptions& options, UpkeepThread thread);
  ~OctreeUpkeep();
  OctreeUpkeep(const OctreeUpkeep&) = delete;
  OctreeUpkeep& operator=(const OctreeUpkeep&) = delete;

  /// Key frames that moved by more than half a voxel are integrated again, new ones are added. In
  /// the background an error ends the upkeep, and Finish does all.
  void Update(KeyframeClouds clouds, KeyframePoseMap world_from_camera);

  /// Ends the upkeep and gives the octree of exactly these poses: what SemanticMapper::Build has.
  SemanticOctree Finish(const KeyframeClouds& clouds, const KeyframePoseMap& world_from_camera);

  /// Of "octree_upkeep"; after Finish.
  const StageTimes& times() const { return times_; }

 private:
  struct Job {
    KeyframeClouds clouds;
    KeyframePoseMap world_from_camera;
  };

  void Integrate(const Job& job);
  void Run(std::stop_token stop);
  void Stop();

  DenseOptions options_;
  UpkeepThread where_;
  OctreeIntegrator integrator_;  // the thread's while there is one
  StageTimes times_;             // likewise
  bool is_whole_ = true;         // likewise; false where an update was cut short by an error
  BoundedQueue<Job> jobs_{1, OverflowPolicy::kLatestOnly};
  std::jthread thread_;
};

}  // namespace ofm
