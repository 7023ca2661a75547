#include "ofm/sim/person.h"

#include <gtest/gtest.h>

#include "ofm/sim/test_scene.h"

namespace ofm {
namespace {

PersonLook TestLook(double height_m) {
  return {height_m, MakeTestTexture(1), MakeTestTexture(2), 0};
}

/// Highest and lowest point of the parts at rest.
std::pair<double, double> VerticalExtent(const Body& body) {
  double low = 1e9, high = -1e9;
  for (const Part& part : body.parts) {
    const double z = part.body_from_part.translation().z();
    low = std::min(low, z - part.half_extent_m.z());
    high = std::max(high, z + part.half_extent_m.z());
  }
  return {low, high};
}

TEST(Person, StandsOnTheFloorAndIsAsTallAsWanted) {
  for (const double height_m : {1.6, 1.75, 1.95}) {
    const auto [low, high] = VerticalExtent(MakePerson(StaticMotion{}, TestLook(height_m)));
    EXPECT_NEAR(low, 0, 1e-9);
    EXPECT_NEAR(high, height_m, 1e-6);
  }
}

TEST(Person, HasTheClassNameOfCoco) {
  EXPECT_EQ(MakePerson(StaticMotion{}, TestLook(1.7)).class_name, "person");
}

TEST(Person, LegsAndArmsSwingAgainstOneAnother) {
  const Body person = MakePerson(StaticMotion{}, TestLook(1.75));
  std::vector<Part> limbs;
  for (const Part& part : person.parts) {
    if (part.swing.amplitude_rad > 0) limbs.push_back(part);
  }
  ASSERT_EQ(limbs.size(), 4U);
  for (const double time_s : {0.2, 0.7}) {
    std::vector<double> reach;  // how far a limb's lower end is before the body
    for (const Part& limb : limbs) {
      const Eigen::Vector3d lower_end(0, 0, -limb.half_extent_m.z());
      reach.push_back((WorldFromPart(person, limb, time_s) * lower_end).x());
    }
    EXPECT_NEAR(reach[0], -reach[2], 1e-9);
    EXPECT_NEAR(reach[1], -reach[3], 1e-9);
    EXPECT_LT(reach[0] * reach[1], 0) << "leg and arm of one side";
    EXPECT_GT(std::abs(reach[0]), 0.05);
  }
}

}  // namespace
}  // namespace ofm
