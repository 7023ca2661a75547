#include "ofm/sim/landmark_world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "ofm/sim/sim_sequence.h"

namespace ofm {
namespace {

LandmarkWorldOptions TestOptions() {
  LandmarkWorldOptions options;
  options.landmarks = 400;
  options.frames = 10;
  return options;
}

/// Projection of the true landmark into the frame of `id`.
Eigen::Vector3d TruePoint(const LandmarkWorld& world, FrameId id, LandmarkId landmark) {
  return world.Pose(id).world_from_camera.Inverse() * world.landmarks_in_world()[landmark.value];
}

TEST(LandmarkWorld, ExactObservationsAreTheProjections) {
  const LandmarkWorld world(TestOptions());
  for (std::uint32_t i = 0; i < world.frame_count(); ++i) {
    const auto observations = world.Observe(FrameId(i));
    EXPECT_GT(observations.size(), 80U);
    for (const LandmarkObservation& seen : observations) {
      const Eigen::Vector3d point = TruePoint(world, FrameId(i), seen.landmark);
      EXPECT_NEAR((seen.ideal_px - world.camera().ProjectIdeal(point)).norm(), 0, 1e-9);
      EXPECT_NEAR(seen.depth_m, point.z(), 1e-12);
      EXPECT_TRUE(world.camera().IsInImage(seen.ideal_px));
      EXPECT_FALSE(seen.is_outlier);
    }
  }
}

TEST(LandmarkWorld, ObservationsAreInOrderOfLandmarks) {
  const auto observations = LandmarkWorld(TestOptions()).Observe(FrameId(0));
  for (std::size_t i = 1; i < observations.size(); ++i) {
    EXPECT_LT(observations[i - 1].landmark, observations[i].landmark);
  }
}

TEST(LandmarkWorld, SameSeedGivesTheSameNoiseAndAnotherFrameOrSeedOther) {
  LandmarkWorldOptions options = TestOptions();
  options.pixel_sigma = 1;
  options.path.kind = CameraPathKind::kStatic;
  const LandmarkWorld a(options), same(options);
  options.seed = 2;
  const LandmarkWorld other(options);
  const auto seen = a.Observe(FrameId(3)), again = same.Observe(FrameId(3));
  ASSERT_EQ(seen.size(), again.size());
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i].ideal_px, again[i].ideal_px);
  EXPECT_NE(seen[0].ideal_px, a.Observe(FrameId(4))[0].ideal_px);
  EXPECT_NE(a.landmarks_in_world()[0], other.landmarks_in_world()[0]);
}

TEST(LandmarkWorld, NoiseHasTheDeviationWanted) {
  LandmarkWorldOptions options = TestOptions();
  options.landmarks = 3000;
  options.pixel_sigma = 0.7;
  options.depth_sigma = 1.4e-3;
  const LandmarkWorld world(options);
  double pixel = 0, depth = 0;
  int count = 0;
  for (std::uint32_t i = 0; i < 5; ++i) {
    for (const LandmarkObservation& seen : world.Observe(FrameId(i))) {
      const Eigen::Vector3d point = TruePoint(world, FrameId(i), seen.landmark);
      pixel += (seen.ideal_px - world.camera().ProjectIdeal(point)).squaredNorm();
      depth += std::pow((seen.depth_m - point.z()) / (point.z() * point.z()), 2);
      ++count;
    }
  }
  EXPECT_GT(count, 3000);
  EXPECT_NEAR(std::sqrt(pixel / (2 * count)), 0.7, 0.03);
  EXPECT_NEAR(std::sqrt(depth / count), 1.4e-3, 0.06e-3);
}

TEST(LandmarkWorld, OutliersAreMarkedAndAsManyAsWanted) {
  LandmarkWorldOptions options = TestOptions();
  options.landmarks = 3000;
  options.outlier_share = 0.3;
  const LandmarkWorld world(options);
  const auto observations = world.Observe(FrameId(0));
  int outliers = 0, far = 0;
  for (const LandmarkObservation& seen : observations) {
    const Eigen::Vector3d point = TruePoint(world, FrameId(0), seen.landmark);
    const double error_px = (seen.ideal_px - world.camera().ProjectIdeal(point)).norm();
    outliers += seen.is_outlier;
    far += error_px > 20;
    if (!seen.is_outlier) {
      EXPECT_LT(error_px, 1e-9);
    }
  }
  EXPECT_NEAR(outliers, 0.3 * observations.size(), 0.05 * observations.size());
  EXPECT_GT(far, 0.9 * outliers);
}

TEST(LandmarkWorld, FarLandmarksAreNotSeen) {
  LandmarkWorldOptions options = TestOptions();
  const std::size_t all = LandmarkWorld(options).Observe(FrameId(0)).size();
  options.max_depth_m = 3;
  const auto near = LandmarkWorld(options).Observe(FrameId(0));
  for (const LandmarkObservation& seen : near) EXPECT_LE(seen.depth_m, 3);
  EXPECT_LT(near.size(), all);
  EXPECT_GT(near.size(), 10U);
}

TEST(LandmarkWorld, PosesFollowThePathAndEndWithIt) {
  const LandmarkWorld world(TestOptions());
  EXPECT_EQ(world.Pose(FrameId(3)).stamp_ns, 300'000'000);
  EXPECT_GT((world.Pose(FrameId(9)).world_from_camera.translation() -
             world.Pose(FrameId(0)).world_from_camera.translation())
                .norm(),
            0.05);
  EXPECT_THROW(world.Pose(FrameId(10)), std::logic_error);
}

}  // namespace
}  // namespace ofm
