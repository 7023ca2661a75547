// An articulated person: joints in, places of the solids out.
#pragma once

#include <array>
#include <vector>

#include "ofm/sim/scene_kit.h"

namespace ofm {

/// Angles of the joints [rad]; index 0 is the right side, 1 the left. All 0: upright, arms hanging.
struct JointAngles {
  double pelvis_m = 0.95;    ///< height of the pelvis above the floor, for a height of 1.85 m
  double lean = 0;           ///< of the trunk, forwards
  double twist = 0;          ///< of the trunk, to the left
  double nod = 0, look = 0;  ///< of the head: down, and to the left
  std::array<double, 2> hip{}, knee{};  ///< thigh forwards; shin backwards against it
  std::array<double, 2> shoulder{}, spread{}, elbow{};  ///< arm forwards, outwards; forearm up
};

/// What somebody looks like.
struct HumanLook {
  double height_m = 1.75;
  TexturePtr shirt, trousers, skin, hair, shoes;
};

/// The solids of a person, for Body::parts; FindJoints places them.
std::vector<Part> MakeHumanParts(SceneKit& kit, const HumanLook& look);

/// body_from_part of each solid of MakeHumanParts. The body's origin is on the floor below the
/// pelvis, x forwards, y to the left, z up.
std::vector<RigidTransform> PlaceHumanParts(const JointAngles& joints, double height_m);

/// Height of the pelvis with which the lower foot touches the floor, for a height of 1.85 m [m].
double StandingPelvis(const JointAngles& joints);

}  // namespace ofm
