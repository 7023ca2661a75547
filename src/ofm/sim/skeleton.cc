#include "ofm/sim/skeleton.h"

#include <algorithm>
#include <cmath>

namespace ofm {
namespace {

using Eigen::Vector3d;

/// Lengths for a height of 1.85 m [m].
constexpr double kReference_m = 1.85;
constexpr double kThigh_m = 0.44, kShin_m = 0.43, kAnkle_m = 0.08, kHipDrop_m = 0.03;
constexpr double kUpperArm_m = 0.29, kForearm_m = 0.25;
constexpr double kHipWidth_m = 0.095, kShoulderWidth_m = 0.2;
constexpr double kBelly_m = 0.2, kChest_m = 0.3;

RigidTransform Shifted(double x, double y, double z) {
  return {Eigen::Quaterniond::Identity(), Vector3d(x, y, z)};
}
RigidTransform Turned(const Vector3d& axis, double angle) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)), Vector3d::Zero()};
}
/// A turn in the plane of walking; positive tips the upper end forwards.
RigidTransform Pitched(double angle) { return Turned(Vector3d::UnitY(), angle); }

/// Appends thigh, knee, shin and foot below `hip`.
void PlaceLeg(const RigidTransform& body_from_hip, double hip, double knee,
              std::vector<RigidTransform>& places) {
  const RigidTransform thigh = body_from_hip * Pitched(-hip);
  const RigidTransform shin = thigh * Shifted(0, 0, -kThigh_m) * Pitched(knee);
  const RigidTransform foot = shin * Shifted(0, 0, -kShin_m) * Pitched(0.6 * (hip - knee));
  places.push_back(thigh * Shifted(0, 0, -0.5 * kThigh_m));
  places.push_back(shin);
  places.push_back(shin * Shifted(0, 0, -0.5 * kShin_m));
  places.push_back(foot * Shifted(0.06, 0, -0.5 * kAnkle_m));
}

/// Appends upper arm, elbow, forearm and hand below `shoulder`.
void PlaceArm(const RigidTransform& chest_from_shoulder, double forwards, double outwards,
              double elbow, std::vector<RigidTransform>& places) {
  const RigidTransform upper =
      chest_from_shoulder * Pitched(-forwards) * Turned(Vector3d::UnitX(), outwards);
  const RigidTransform forearm = upper * Shifted(0, 0, -kUpperArm_m) * Pitched(-elbow);
  places.push_back(upper * Shifted(0, 0, -0.5 * kUpperArm_m));
  places.push_back(forearm);
  places.push_back(forearm * Shifted(0, 0, -0.5 * kForearm_m));
  places.push_back(forearm * Shifted(0, 0, -kForearm_m - 0.06));
}

}  // namespace

std::vector<Part> MakeHumanParts(SceneKit& kit, const HumanLook& look) {
  const double s = look.height_m / kReference_m;
  const auto cylinder = [&](double x, double y, double z, const TexturePtr& texture, double taper) {
    return kit.Cylinder(s * Vector3d(x, y, z), {}, texture, taper);
  };
  const auto ellipsoid = [&](double x, double y, double z, const TexturePtr& texture) {
    return kit.Ellipsoid(s * Vector3d(x, y, z), {}, texture);
  };
  std::vector<Part> parts = {ellipsoid(0.125, 0.165, 0.13, look.trousers),
                             cylinder(0.115, 0.15, 0.5 * kBelly_m + 0.03, look.shirt, 0.04),
                             cylinder(0.12, 0.175, 0.5 * kChest_m, look.shirt, 0.1),
                             ellipsoid(0.125, 0.225, 0.085, look.shirt),
                             cylinder(0.052, 0.055, 0.06, look.skin, -0.05),
                             ellipsoid(0.098, 0.078, 0.125, look.skin),
                             ellipsoid(0.102, 0.086, 0.1, look.hair),
                             ellipsoid(0.022, 0.016, 0.022, look.skin)};
  for (int side = 0; side < 2; ++side) {
    parts.push_back(cylinder(0.072, 0.072, 0.5 * kThigh_m, look.trousers, 0.22));
    parts.push_back(ellipsoid(0.058, 0.058, 0.062, look.trousers));
    parts.push_back(cylinder(0.05, 0.05, 0.5 * kShin_m, look.trousers, 0.14));
    parts.push_back(ellipsoid(0.135, 0.05, 0.055, look.shoes));
    parts.push_back(cylinder(0.047, 0.047, 0.5 * kUpperArm_m, look.shirt, 0.12));
    parts.push_back(ellipsoid(0.042, 0.042, 0.045, look.shirt));
    parts.push_back(cylinder(0.034, 0.034, 0.5 * kForearm_m, look.skin, 0.16));
    parts.push_back(ellipsoid(0.028, 0.042, 0.085, look.skin));
  }
  return parts;
}

std::vector<RigidTransform> PlaceHumanParts(const JointAngles& joints, double height_m) {
  const RigidTransform pelvis = Shifted(0, 0, joints.pelvis_m);
  const RigidTransform belly =
      pelvis * Shifted(0, 0, 0.06) * Turned(Vector3d::UnitZ(), joints.twist) * Pitched(joints.lean);
  const RigidTransform chest = belly * Shifted(0, 0, kBelly_m) * Pitched(0.3 * joints.lean);
  const RigidTransform neck = chest * Shifted(0.005, 0, kChest_m);
  const RigidTransform head = neck * Shifted(0.01, 0, 0.09) *
                              Turned(Vector3d::UnitZ(), joints.look) *
                              Pitched(joints.nod - 0.8 * joints.lean);
  std::vector<RigidTransform> places = {pelvis,
                                        belly * Shifted(0, 0, 0.5 * kBelly_m),
                                        chest * Shifted(0, 0, 0.5 * kChest_m - 0.03),
                                        chest * Shifted(0, 0, kChest_m - 0.055),
                                        neck * Shifted(0, 0, 0.03),
                                        head * Shifted(0.01, 0, 0.085),
                                        head * Shifted(-0.022, 0, 0.125),
                                        head * Shifted(0.1, 0, 0.075)};
  for (int side = 0; side < 2; ++side) {
    const double sign = side == 0 ? -1 : 1;
    PlaceLeg(pelvis * Shifted(0, sign * kHipWidth_m, -kHipDrop_m), joints.hip[side],
             joints.knee[side], places);
    PlaceArm(chest * Shifted(0, sign * kShoulderWidth_m, kChest_m - 0.05), joints.shoulder[side],
             sign * (0.06 + joints.spread[side]), joints.elbow[side], places);
  }
  const double s = height_m / kReference_m;
  for (RigidTransform& place : places) place = {place.rotation(), s * place.translation()};
  return places;
}

double StandingPelvis(const JointAngles& joints) {
  double leg_m = 0;
  for (int side = 0; side < 2; ++side) {
    leg_m = std::max(leg_m, kThigh_m * std::cos(joints.hip[side]) +
                                kShin_m * std::cos(joints.knee[side] - joints.hip[side]));
  }
  return leg_m + kAnkle_m + kHipDrop_m;
}

}  // namespace ofm
