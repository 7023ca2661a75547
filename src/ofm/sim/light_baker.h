// Computes once how much light falls on what stands still.
#pragma once

#include <vector>

#include "ofm/sim/light_map.h"

namespace ofm {

struct Body;

/// Light on the faces of all boxes and rectangles whose body stands still: from each lamp as far as
/// nothing that stands still is between (soft shadows, by rays to points all over the lamp), and
/// from everywhere as far as nothing is close by (ambient occlusion: Zhukov et al., "An ambient
/// light illumination model", EGWR 1998). A rectangle is lit on the side to which u x v points.
BakedLight BakeLight(const std::vector<Body>& bodies, const Lighting& lighting);

/// A lamp's light on a small surface at `point` with the unit `normal`, were nothing in between.
double UnshadowedLight(const Lamp& lamp, const Eigen::Vector3d& point_in_world,
                       const Eigen::Vector3d& normal_in_world);

}  // namespace ofm
