#include "ofm/pipeline/dense_upkeep.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "ofm/pipeline/thread_urgency.h"

namespace ofm {
namespace {

/// Updates that may wait with the views of their key frames (some 10 MB each), and at all (4 MB).
constexpr std::size_t kWithViews = 4, kAtAll = 16;

}  // namespace

DenseUpkeep::DenseUpkeep(SemanticMapper& semantic_mapper, ObjectMapper& object_mapper,
                         UpkeepThread thread)
    : semantic_mapper_(semantic_mapper),
      object_mapper_(object_mapper),
      octree_(semantic_mapper.options()),
      where_(thread),
      updates_(kAtAll) {}

void DenseUpkeep::Update(DenseUpdate update) {
  if (where_ == UpkeepThread::kCaller) {
    Add(update);
    KeepUpOctree(update);
    return;
  }
  if (const std::exception_ptr error = error_.Get()) {
    error_.Set(nullptr);
    std::rethrow_exception(error);
  }
  if (updates_.size() >= kWithViews) {
    for (DenseJob& job : update.jobs) {
      views_left_out_ += job.views.size();
      job.views.clear();
    }
  }
  updates_.Push(std::move(update));
  if (thread_.joinable()) return;
  thread_ = std::jthread([this](const std::stop_token& stop) {
    LowerThreadPriority(kDenseNiceness);
    Drain(stop);
  });
}

/// The thread, and the caller's last call.
void DenseUpkeep::Drain(const std::stop_token& stop) {
  try {
    while (const std::optional<DenseUpdate> update = updates_.Pop(stop)) {
      Add(*update);
      if (updates_.size() == 0) KeepUpOctree(*update);
    }
  } catch (...) {
    error_.Set(std::current_exception());
    updates_.Close();
    while (updates_.TryPop()) continue;  // nothing is done after an error
  }
}

void DenseUpkeep::Add(const DenseUpdate& update) {
  for (const DenseJob& job : update.jobs) {
    if (!job.labelled.depth_m.empty()) {
      ScopedStageTimer timer(times_, "semantic_cloud");
      semantic_mapper_.AddKeyframe(job.labelled, job.views);
    }
    if (!job.instances.depth_m.empty()) {
      ScopedStageTimer timer(times_, "object_observation");
      object_mapper_.AddKeyframe(job.instances);
    }
  }
  BoundClouds(*update.map);
}

void DenseUpkeep::KeepUpOctree(const DenseUpdate& update) {
  if (update.world_from_camera.empty()) return;
  ScopedStageTimer timer(times_, "octree_upkeep");
  octree_.Update(semantic_mapper_.clouds(), update.world_from_camera);
}

/// What key frames saw that the map let go, others saw too: of these clouds the oldest go, a
/// quarter of the limit at once, as the octree is rebuilt without them.
void DenseUpkeep::BoundClouds(const MapSnapshot& map) {
  const auto limit = static_cast<std::size_t>(semantic_mapper_.options().max_spare_clouds);
  std::vector<KeyframeId> spare;
  for (const auto& [id, cloud] : semantic_mapper_.clouds()) {
    if (map.keyframes.Find(id) == nullptr) spare.push_back(id);
  }
  if (spare.size() <= limit) return;
  spare.resize(spare.size() - limit + limit / 4);
  for (const KeyframeId id : spare) semantic_mapper_.RemoveKeyframe(id);
}

std::exception_ptr DenseUpkeep::Finish() {
  updates_.Close();
  thread_ = std::jthread();  // stops once it has done what it is at
  Drain({});                 // as urgently as the caller is
  if (views_left_out_ > 0) {
    spdlog::info("the dense map lacks {} frames between key frames: the machine was too busy",
                 std::exchange(views_left_out_, 0));
  }
  const std::exception_ptr error = error_.Get();
  error_.Set(nullptr);
  return error;
}

SemanticOctree DenseUpkeep::FinishOctree(const KeyframePoseMap& world_from_camera) {
  return octree_.Finish(semantic_mapper_.clouds(), world_from_camera);
}

}  // namespace ofm
