#include "ofm/objects/object_mapper.h"

#include "ofm/base/check.h"
#include "ofm/objects/join_objects.h"
#include "ofm/objects/up_direction.h"

namespace ofm {

ObjectMapper::ObjectMapper(const PinholeCamera& camera, const ObjectOptions& options,
                           const ClassPolicies& policies)
    : camera_(camera), options_(options), observer_(camera, options.observation, policies) {}

void ObjectMapper::AddKeyframe(const InstanceFrame& frame) {
  OFM_CHECK(frame.id.valid());
  keyframes_.insert_or_assign(frame.id, observer_.Observe(frame));
}

ObjectInventory ObjectMapper::Build(
    const std::map<KeyframeId, RigidTransform>& world_from_camera) const {
  ObjectInventory inventory;
  inventory.up_in_world = EstimateUp(camera_, keyframes_, world_from_camera);
  inventory.objects =
      JoinObjects({camera_, keyframes_, world_from_camera, inventory.up_in_world}, options_);
  return inventory;
}

}  // namespace ofm
