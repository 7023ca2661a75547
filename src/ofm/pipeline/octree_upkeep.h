// The octree kept up with the map while a run goes on.
#pragma once

#include <stop_token>
#include <thread>

#include "ofm/base/bounded_queue.h"
#include "ofm/base/timing.h"
#include "ofm/dense/octree_integrator.h"
#include "ofm/dense/settled_poses.h"

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

  /// New key frames are added, and those that moved by more than half a voxel are integrated again,
  /// when their poses have settled. As that goes through everything around them, it waits until as
  /// many were added as the last time cost: all in all the upkeep costs about twice what adding
  /// does. In the background an error ends the upkeep, and Finish does all.
  void Update(KeyframeClouds clouds, const KeyframePoseMap& world_from_camera);

  /// Ends the upkeep and gives the octree of exactly these poses: what SemanticMapper::Build has.
  SemanticOctree Finish(const KeyframeClouds& clouds, const KeyframePoseMap& world_from_camera);

  /// Of "octree_upkeep"; after Finish.
  const StageTimes& times() const { return times_; }

 private:
  struct Job {
    KeyframeClouds clouds;
    KeyframePoseMap world_from_camera;
  };

  double Tolerance_m() const { return options_.resolution_m / 2; }
  void Integrate(const Job& job);
  void Run(std::stop_token stop);
  void Stop();

  DenseOptions options_;
  UpkeepThread where_;
  SettledPoses settled_;
  OctreeIntegrator integrator_;  // the thread's while there is one
  StageTimes times_;             // likewise
  std::ptrdiff_t credit_ = 0;    // likewise; key frames added over those integrated again
  bool is_whole_ = true;         // likewise; false where an update was cut short by an error
  BoundedQueue<Job> jobs_{1, OverflowPolicy::kLatestOnly};
  std::jthread thread_;
};

}  // namespace ofm
