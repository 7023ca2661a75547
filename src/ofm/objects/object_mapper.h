// From the instances of key frames, and the key frames' poses, to the objects of a room.
#pragma once

#include <map>
#include <vector>

#include "ofm/geometry/rigid_transform.h"
#include "ofm/objects/object_observation.h"
#include "ofm/objects/object_options.h"
#include "ofm/objects/scene_object.h"

namespace ofm {

/// Keeps what each key frame saw in its camera's frame, and joins it when the poses are known: it
/// is right after any loop closure. Not thread-safe.
class ObjectMapper {
 public:
  ObjectMapper(const PinholeCamera& camera, const ObjectOptions& options,
               const ClassPolicies& policies);

  /// Keeps the instances that stand still; the images are not kept. A key frame that is there
  /// already is replaced.
  void AddKeyframe(const InstanceFrame& frame);

  /// Objects and the upward direction; no tracks. Key frames without a pose are left out.
  ObjectInventory Build(const std::map<KeyframeId, RigidTransform>& world_from_camera) const;

  /// Key frames that are held.
  std::size_t size() const { return keyframes_.size(); }

 private:
  PinholeCamera camera_;
  ObjectOptions options_;
  ObjectObserver observer_;
  std::map<KeyframeId, KeyframeObjects> keyframes_;
};

}  // namespace ofm
