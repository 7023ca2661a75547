#include "ofm/eval/ate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ofm/base/error.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

Trajectory Helix(int count) {
  Trajectory trajectory;
  for (int i = 0; i < count; ++i) {
    const double t = 0.1 * i;
    trajectory.push_back(
        {i * 33'000'000LL, {ExpSo3({t, 0, 0.1}), {std::cos(t), std::sin(t), 0.1 * t}}});
  }
  return trajectory;
}

Trajectory Moved(const RigidTransform& other_from_world, const Trajectory& trajectory) {
  Trajectory moved;
  for (const auto& [stamp_ns, pose] : trajectory) {
    moved.push_back({stamp_ns, other_from_world * pose});
  }
  return moved;
}

TEST(Ate, RecoversARigidTransform) {
  const Trajectory truth = Helix(50);
  const RigidTransform estimate_from_truth(ExpSo3({0.4, -1, 2}), {5, 6, -7});
  const AteResult ate = ComputeAte(Moved(estimate_from_truth, truth), truth);
  EXPECT_EQ(ate.translation_m.count, 50u);
  EXPECT_LT(ate.translation_m.max, 1e-12);
  const RigidTransform identity = ate.truth_from_estimate * estimate_from_truth;
  EXPECT_LT(identity.translation().norm(), 1e-12);
  EXPECT_LT(identity.RotationAngle(), 1e-7);
  ASSERT_EQ(ate.aligned_estimate.size(), 50u);
  const RigidTransform residual =
      ate.aligned_estimate[7].world_from_camera.Inverse() * truth[7].world_from_camera;
  EXPECT_LT(residual.translation().norm() + residual.RotationAngle(), 1e-7);
}

TEST(Ate, MovesByAKnownTransformWhereThereIsOne) {
  const Trajectory truth = Helix(50);
  const RigidTransform truth_from_estimate(ExpSo3({0.4, -1, 2}), {5, 6, -7});
  const Trajectory estimate = Moved(truth_from_estimate.Inverse(), truth);
  const Trajectory off = Moved({Eigen::Quaterniond::Identity(), {0.3, 0, 0.4}}, estimate);
  EXPECT_LT(ComputeAte(off, truth).translation_m.max, 1e-12) << "the best one hides it";
  const AteResult ate = ComputeAte(off, truth, kMaxStampDifference_s, truth_from_estimate);
  EXPECT_NEAR(ate.translation_m.min, 0.5, 1e-12);
  EXPECT_NEAR(ate.translation_m.max, 0.5, 1e-12);
  EXPECT_EQ(ate.truth_from_estimate.translation(), truth_from_estimate.translation());
}

TEST(AlignPoses, FindsTheRotationThatAStraightPathLeavesOpen) {
  Trajectory truth;
  for (int i = 0; i < 10; ++i) {
    truth.push_back({i * 33'000'000LL, {ExpSo3({0, 0.02 * i, 0}), {0.01 * i, 0, 0}}});
  }
  const RigidTransform estimate_from_truth(ExpSo3({2, -1, 0.5}), {5, 6, -7});
  const Trajectory estimate = Moved(estimate_from_truth, truth);
  const RigidTransform residual = AlignPoses(estimate, truth) * estimate_from_truth;
  EXPECT_LT(residual.translation().norm() + residual.RotationAngle(), 1e-7);
}

TEST(AlignPoses, AgreesWithThePositionsOfALongPath) {
  const Trajectory truth = Helix(50);
  const Trajectory estimate = Moved({ExpSo3({0.4, -1, 2}), {5, 6, -7}}, truth);
  const RigidTransform difference =
      AlignPoses(estimate, truth) * ComputeAte(estimate, truth).truth_from_estimate.Inverse();
  EXPECT_LT(difference.translation().norm() + difference.RotationAngle(), 1e-6);
  EXPECT_THROW(AlignPoses(Helix(1), truth), Error);
}

TEST(Ate, DoesNotCorrectScale) {
  const Trajectory truth = Helix(50);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate) {
    pose.world_from_camera = {pose.world_from_camera.rotation(),
                              1.1 * pose.world_from_camera.translation()};
  }
  // A tenth of the distance from the centroid stays.
  EXPECT_GT(ComputeAte(estimate, truth).translation_m.rmse, 0.09);
}

TEST(Ate, NeverMirrors) {
  const Trajectory truth = Helix(50);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate) {
    Eigen::Vector3d mirrored = pose.world_from_camera.translation();
    mirrored.x() *= -1;
    pose.world_from_camera = {pose.world_from_camera.rotation(), mirrored};
  }
  EXPECT_GT(ComputeAte(estimate, truth).translation_m.rmse, 0.01);
}

TEST(Ate, GivesTheErrorOfEachPose) {
  // Symmetric errors about the truth, so that the alignment is the identity.
  const Trajectory truth = {{0, {Eigen::Quaterniond::Identity(), {0, 0, 0}}},
                            {1'000'000'000, {Eigen::Quaterniond::Identity(), {10, 0, 0}}}};
  const Trajectory estimate = {{1'000'000, {Eigen::Quaterniond::Identity(), {-0.2, 0, 0}}},
                               {500'000'000, {Eigen::Quaterniond::Identity(), {99, 99, 99}}},
                               {1'001'000'000, {Eigen::Quaterniond::Identity(), {10.2, 0, 0}}}};
  const AteResult ate = ComputeAte(estimate, truth);
  ASSERT_EQ(ate.errors.size(), 2u);
  EXPECT_EQ(ate.errors[0].stamp_ns, 1'000'000);
  EXPECT_EQ(ate.errors[1].stamp_ns, 1'001'000'000);
  EXPECT_NEAR(ate.errors[0].error_m, 0.2, 1e-12);
  EXPECT_NEAR(ate.errors[1].error_m, 0.2, 1e-12);
  EXPECT_NEAR(ate.translation_m.rmse, 0.2, 1e-12);
  EXPECT_EQ(ate.aligned_estimate.size(), 3u);  // those without truth as well
}

TEST(Ate, APoseThatStandsStillIsAligned) {
  Trajectory estimate = Helix(20);
  for (StampedPose& pose : estimate) pose.world_from_camera = {};
  const AteResult ate = ComputeAte(estimate, Helix(20));
  EXPECT_TRUE(ate.truth_from_estimate.IsFinite());
  EXPECT_GT(ate.translation_m.rmse, 0.1);
}

TEST(Ate, TrajectoriesOfDifferentRecordingsAreAnError) {
  Trajectory later = Helix(20);
  for (StampedPose& pose : later) pose.stamp_ns += 1'000'000'000'000;
  EXPECT_THAT(
      ErrorOf([&] { ComputeAte(later, Helix(30)); }),
      testing::HasSubstr("0 of 20 estimated poses have one of 30 true poses within 0.02 s"));
  EXPECT_THAT(ErrorOf([&] { ComputeAte({}, Helix(30)); }), testing::HasSubstr("0 of 0"));
}

TEST(Ate, TheLimitOfTheAssociationCounts) {
  Trajectory late = Helix(20);
  for (StampedPose& pose : late) pose.stamp_ns += 15'000'000;
  EXPECT_EQ(ComputeAte(late, Helix(20)).translation_m.count, 20u);
  EXPECT_NE(ErrorOf([&] { ComputeAte(late, Helix(20), 0.01); }), "");
}

}  // namespace
}  // namespace ofm
