// Which way is up.
#pragma once

#include <Eigen/Core>
#include <map>

#include "ofm/base/ids.h"
#include "ofm/camera/pinhole_camera.h"
#include "ofm/geometry/rigid_transform.h"
#include "ofm/objects/object_observation.h"

namespace ofm {

/// The direction against gravity in the world, a unit vector: the normal that most surfaces within
/// 50 degrees of the cameras' mean upward direction share, as floors and desks do. Where there is
/// none, that mean. Right for cameras that are held upright on average.
Eigen::Vector3d EstimateUp(const PinholeCamera& camera,
                           const std::map<KeyframeId, KeyframeObjects>& keyframes,
                           const std::map<KeyframeId, RigidTransform>& world_from_camera);

}  // namespace ofm
