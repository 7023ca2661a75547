#include "ofm/objects/up_direction.h"

#include <gtest/gtest.h>

#include "ofm/objects/test_room.h"

namespace ofm {
namespace {

/// A floor under, and a wall before, a camera that looks down by `tilt_rad`.
Eigen::Vector3d UpSeenBy(double tilt_rad) {
  const std::vector<test::Box> room{{{-4, 1, -4}, {4, 1.2, 6}, test::kGrey, kNoLabel, false},
                                    {{-4, -4, 4}, {4, 4, 4.2}, test::kGrey, kNoLabel, false}};
  const RigidTransform pose(
      Eigen::Quaterniond(Eigen::AngleAxisd(-tilt_rad, Eigen::Vector3d::UnitX())),
      Eigen::Vector3d(0, 0, 0));
  const ObjectObserver observer(test::SmallCamera(), {}, test::Policies());
  const InstanceFrame frame = test::Look(test::SmallCamera(), room, pose, KeyframeId(0));
  return EstimateUp(test::SmallCamera(), {{KeyframeId(0), observer.Observe(frame)}},
                    {{KeyframeId(0), pose}});
}

TEST(EstimateUp, IsTheNormalOfTheFloorHoweverTheCameraIsTilted) {
  for (const double tilt_rad : {.2, .5, .8}) {
    EXPECT_GT(UpSeenBy(tilt_rad).dot(-Eigen::Vector3d::UnitY()), .999) << tilt_rad;
  }
}

TEST(EstimateUp, WithoutSurfacesIsTheCamerasMeanUp) {
  const RigidTransform pose(Eigen::Quaterniond(Eigen::AngleAxisd(.5, Eigen::Vector3d::UnitZ())),
                            {0, 0, 0});
  const Eigen::Vector3d up = EstimateUp(test::SmallCamera(), {}, {{KeyframeId(0), pose}});
  EXPECT_LT((up + pose.rotation() * Eigen::Vector3d::UnitY()).norm(), 1e-9);
  EXPECT_EQ(EstimateUp(test::SmallCamera(), {}, {}), -Eigen::Vector3d::UnitY());
}

}  // namespace
}  // namespace ofm
