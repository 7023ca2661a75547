#include "ofm/dense/settled_poses.h"

#include "ofm/dense/octree_integrator.h"

namespace ofm {

const KeyframePoseMap& SettledPoses::Update(const KeyframePoseMap& world_from_camera) {
  std::erase_if(settled_,
                [&](const auto& known) { return !world_from_camera.contains(known.first); });
  bool one_waits = false;
  for (const auto& [id, pose] : world_from_camera) {
    const auto before = last_.find(id);
    const bool rests =
        before != last_.end() && MapShift_m(before->second, pose, options_) <= tolerance_m_;
    const bool is_new = !settled_.contains(id);
    if (rests && !(is_new && one_waits)) settled_[id] = pose;
    one_waits |= is_new && !rests;
  }
  last_ = world_from_camera;
  return settled_;
}

}  // namespace ofm
