#include "ofm/estimation/minimal_pose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "ofm/estimation/reprojection.h"
#include "ofm/estimation/test_world.h"

namespace ofm {
namespace {

const PinholeCamera kCamera = *FindCameraPreset("tum-fr2");
const RigidTransform kTruth(ExpSo3(Eigen::Vector3d(-1.3, 0.2, 0.5)), Eigen::Vector3d(3, -2, 0.5));

MinimalSample MakeSample(int seed, test::Depths depths) {
  RandomEngine engine = MakeRandomEngine(1, seed);
  const auto frame = test::MakeFrame(kCamera, kTruth, 3, depths, {.factor = 0}, engine);
  return {frame[0], frame[1], frame[2]};
}

MinimalSample MakeSampleInLine() {
  MinimalSample sample = MakeSample(0, test::Depths::kAll);
  RandomEngine engine = MakeRandomEngine(0, 0);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d point =
        Eigen::Vector3d(-0.3, 0.1, 2) + i * Eigen::Vector3d(0.2, 0.1, 0.3);
    sample[i].point_in_world = kTruth.Inverse() * point;
    sample[i].seen = test::Observe(kCamera, point, {.factor = 0}, engine);
  }
  return sample;
}

TEST(MinimalPose, DepthGivesThePose) {
  for (int seed = 0; seed < 20; ++seed) {
    const auto poses = PosesFromDepth(kCamera, MakeSample(seed, test::Depths::kAll));
    ASSERT_EQ(poses.size(), 1);
    EXPECT_LT(test::Difference(poses[0], kTruth).norm(), 1e-8);
  }
}

TEST(MinimalPose, PixelsGiveThePoseAmongUpToFour) {
  int found = 0;
  for (int seed = 0; seed < 50; ++seed) {
    const MinimalSample sample = MakeSample(seed, test::Depths::kNone);
    const auto poses = PosesFromPixels(kCamera, sample);
    EXPECT_LE(poses.size(), 4);
    found += std::any_of(poses.begin(), poses.end(), [](const RigidTransform& pose) {
      return test::Difference(pose, kTruth).norm() < 1e-4;
    });
  }
  EXPECT_GE(found, 48);  // the rest are close to a double root
}

TEST(MinimalPose, PointsInOneLineGiveNone) {
  EXPECT_TRUE(PosesFromDepth(kCamera, MakeSampleInLine()).empty());
  EXPECT_TRUE(PosesFromPixels(kCamera, MakeSampleInLine()).empty());
}

TEST(MinimalPose, AskingForDepthThatIsNotThereIsTheProgrammersFault) {
  EXPECT_THROW(PosesFromDepth(kCamera, MakeSample(1, test::Depths::kNone)), std::logic_error);
}

}  // namespace
}  // namespace ofm
