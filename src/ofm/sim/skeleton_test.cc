#include "ofm/sim/skeleton.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ofm/sim/human_script.h"

namespace ofm {
namespace {

/// Lowest and highest point of a standing person's solids [m].
std::pair<double, double> HeightRange(const JointAngles& joints, double height_m) {
  SceneKit kit(1);
  const TexturePtr cloth = kit.Paint(Material::kPlain);
  const std::vector<Part> parts =
      MakeHumanParts(kit, {height_m, cloth, cloth, cloth, cloth, cloth});
  const std::vector<RigidTransform> places = PlaceHumanParts(joints, height_m);
  EXPECT_EQ(parts.size(), places.size());
  double low = 1e9, high = -1e9;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Eigen::Vector3d row = places[k].RotationMatrix().row(2);
    const Eigen::Vector3d reach = row.cwiseProduct(parts[k].half_extent_m);
    const double half = parts[k].shape == Shape::kEllipsoid ? reach.norm() : reach.cwiseAbs().sum();
    low = std::min(low, places[k].translation().z() - half);
    high = std::max(high, places[k].translation().z() + half);
  }
  return {low, high};
}

TEST(Skeleton, StandsOnTheFloorAndIsAsTallAsAsked) {
  JointAngles joints;
  joints.pelvis_m = StandingPelvis(joints);
  for (const double height : {1.5, 1.75, 1.95}) {
    const auto [low, high] = HeightRange(joints, height);
    EXPECT_NEAR(low, 0, 0.04) << height;
    EXPECT_NEAR(high, height, 0.06) << height;
  }
}

TEST(Skeleton, WalkingFeetDoNotSinkOrFly) {
  HumanState state;
  state.gait = 1;
  for (double stride = 0; stride < 6.3; stride += 0.3) {
    state.stride_rad = stride;
    const auto [low, high] = HeightRange(FindJoints(state, 0, 0, 0), 1.75);
    EXPECT_NEAR(low, 0, 0.09) << stride;
    EXPECT_GT(high, 1.6) << stride;
  }
}

TEST(Skeleton, SidesAreMirrored) {
  JointAngles joints;
  joints.hip = {0.3, 0.3};
  joints.elbow = {0.8, 0.8};
  const std::vector<RigidTransform> places = PlaceHumanParts(joints, 1.75);
  const std::size_t limbs = (places.size() - 8) / 2;
  for (std::size_t k = 0; k < limbs; ++k) {
    const Eigen::Vector3d right = places[8 + k].translation();
    const Eigen::Vector3d left = places[8 + limbs + k].translation();
    EXPECT_NEAR(right.x(), left.x(), 1e-9);
    EXPECT_NEAR(right.y(), -left.y(), 1e-9);
    EXPECT_NEAR(right.z(), left.z(), 1e-9);
  }
}

TEST(Skeleton, HipBringsTheKneeForwardsAndKneeTheFootBack) {
  JointAngles joints;
  joints.hip[0] = 1;
  const auto raised = PlaceHumanParts(joints, 1.75);
  joints.knee[0] = 1;
  const auto bent = PlaceHumanParts(joints, 1.75);
  EXPECT_GT(raised[9].translation().x(), 0.3) << "knee";
  EXPECT_LT(bent[11].translation().x(), raised[11].translation().x() - 0.2) << "foot";
}

TEST(Skeleton, BentLegsLowerThePelvis) {
  JointAngles joints;
  const double straight = StandingPelvis(joints);
  joints.hip = {0.4, 0.4};
  joints.knee = {0.8, 0.8};
  EXPECT_LT(StandingPelvis(joints), straight - 0.05);
}

}  // namespace
}  // namespace ofm
