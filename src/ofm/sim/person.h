// A person of ellipsoids and boxes who walks.
#pragma once

#include <memory>

#include "ofm/sim/scene.h"

namespace ofm {

struct PersonLook {
  double height_m = 1.75;
  std::shared_ptr<const Texture> upper, lower;  ///< what they wear
  double stride_phase_rad = 0;
};

/// Class "person": torso, head, arms and legs that swing. The body's origin is on the floor
/// between the feet, x forward, z up.
Body MakePerson(const Motion& motion, const PersonLook& look);

}  // namespace ofm
