#include "ofm/pipeline/octree_upkeep.h"

#include <spdlog/spdlog.h>

#include <limits>

#include "ofm/base/thread_priority.h"
#include "ofm/pipeline/thread_urgency.h"

namespace ofm {

OctreeUpkeep::OctreeUpkeep(const DenseOptions& options, UpkeepThread thread)
    : options_(options), where_(thread), settled_(options, Tolerance_m()), integrator_(options) {}

OctreeUpkeep::~OctreeUpkeep() { Stop(); }

void OctreeUpkeep::Update(KeyframeClouds clouds, const KeyframePoseMap& world_from_camera) {
  Job job{std::move(clouds), settled_.Update(world_from_camera)};
  if (where_ == UpkeepThread::kCaller) return Integrate(job);
  jobs_.Push(std::move(job));
  if (!thread_.joinable()) thread_ = std::jthread([this](std::stop_token stop) { Run(stop); });
}

void OctreeUpkeep::Integrate(const Job& job) {
  ScopedStageTimer timer(times_, "octree_upkeep");
  is_whole_ = false;
  constexpr double kAnywhere_m = std::numeric_limits<double>::infinity();
  const IntegrationCounts counts = integrator_.Update(job.clouds, job.world_from_camera,
                                                      credit_ >= 0 ? Tolerance_m() : kAnywhere_m);
  credit_ += static_cast<std::ptrdiff_t>(counts.added) -
             static_cast<std::ptrdiff_t>(counts.moved + counts.reintegrated);
  is_whole_ = true;
}

/// The thread. After an error Finish begins anew, and throws what is wrong for good.
void OctreeUpkeep::Run(std::stop_token stop) {
  LowerThreadPriority(kUpkeepNiceness);
  try {
    while (const std::optional<Job> job = jobs_.Pop(stop)) Integrate(*job);
  } catch (const std::exception& error) {
    spdlog::warn("octree upkeep ends: {}", error.what());
    jobs_.Close();
  }
}

void OctreeUpkeep::Stop() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  thread_.join();
}

SemanticOctree OctreeUpkeep::Finish(const KeyframeClouds& clouds,
                                    const KeyframePoseMap& world_from_camera) {
  Stop();
  if (!is_whole_) integrator_ = OctreeIntegrator(options_);
  is_whole_ = false;
  integrator_.Update(clouds, world_from_camera, 0);
  is_whole_ = true;
  return integrator_.Take();
}

}  // namespace ofm
