#include "ofm/estimation/point_pair_alignment.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "ofm/estimation/test_world.h"

namespace ofm {
namespace {

const PinholeCamera kCamera = *FindCameraPreset("tum-fr1");
const RigidTransform kTruth(ExpSo3({0.05, -0.2, 0.1}), Eigen::Vector3d(0.3, -0.1, 0.2));

/// A point that both cameras measure, before the source's.
PointPair MakePair(RandomEngine& engine) {
  PointPair pair;
  const Eigen::Vector3d point =
      kCamera.UnprojectIdeal(test::RandomPixel(kCamera, engine), 1 + 3 * UniformReal(engine));
  pair.seen_in_source = test::Observe(kCamera, point, {}, engine);
  pair.seen_in_target = test::Observe(kCamera, kTruth * point, {}, engine);
  pair.point_in_source =
      kCamera.UnprojectIdeal(pair.seen_in_source.ideal_px, pair.seen_in_source.depth_m);
  pair.point_in_target =
      kCamera.UnprojectIdeal(pair.seen_in_target.ideal_px, pair.seen_in_target.depth_m);
  // The gates are for exact points; here both ends are noisy.
  for (PointObservation* seen : {&pair.seen_in_source, &pair.seen_in_target}) {
    seen->pixel_sigma *= 2;
    seen->inverse_depth_sigma *= 2;
  }
  return pair;
}

/// The first `wrong` pairs are of points that have nothing to do with one another.
std::vector<PointPair> MakePairs(int count, int wrong, int seed) {
  RandomEngine engine = MakeRandomEngine(5, seed);
  std::vector<PointPair> pairs;
  for (int i = 0; i < count; ++i) pairs.push_back(MakePair(engine));
  for (int i = 0; i < wrong; ++i) {
    const PointPair other = MakePair(engine);
    pairs[i].point_in_target = other.point_in_target;
    pairs[i].seen_in_target = other.seen_in_target;
  }
  return pairs;
}

std::optional<PairAlignment> Align(const std::vector<PointPair>& pairs, int min_inliers = 20,
                                   const RansacLimits& limits = {}) {
  RandomEngine engine = MakeRandomEngine(6, 0);
  return AlignPairsRansac(kCamera, pairs, min_inliers, limits, engine);
}

TEST(PointPairAlignment, SixOfTenPairsMayBeWrong) {
  for (int seed = 0; seed < 10; ++seed) {
    const auto alignment = Align(MakePairs(100, 60, seed));
    ASSERT_TRUE(alignment) << seed;
    EXPECT_LT(test::Difference(alignment->target_from_source, kTruth).norm(), 0.01) << seed;
    int right = 0, wrong = 0;
    for (int i = 0; i < 100; ++i) (i < 60 ? wrong : right) += alignment->inlier[i];
    EXPECT_GE(right, 36) << seed;
    EXPECT_LE(wrong, 1) << seed;
    EXPECT_EQ(alignment->inlier_count, right + wrong);
  }
}

TEST(PointPairAlignment, WrongPairsAloneAreNoPose) {
  for (int seed = 0; seed < 10; ++seed) EXPECT_FALSE(Align(MakePairs(100, 100, seed))) << seed;
}

TEST(PointPairAlignment, FewerThanTheInliersAskedForAreNoPose) {
  EXPECT_TRUE(Align(MakePairs(30, 5, 1), 20));
  EXPECT_FALSE(Align(MakePairs(30, 15, 1), 20));
  EXPECT_FALSE(Align(MakePairs(19, 0, 1), 20));
}

TEST(PointPairAlignment, BothImagesMustAgree) {
  std::vector<PointPair> pairs = MakePairs(60, 0, 2);
  for (int i = 0; i < 20; ++i) pairs[i].seen_in_source.ideal_px.x() += 50;
  for (int i = 20; i < 30; ++i) pairs[i].seen_in_target.ideal_px.y() += 50;
  const auto alignment = Align(pairs);
  ASSERT_TRUE(alignment);
  for (int i = 0; i < 30; ++i) EXPECT_FALSE(alignment->inlier[i]) << i;
  EXPECT_GE(alignment->inlier_count, 26);
}

TEST(PointPairAlignment, PointsInOneLineAreNoPose) {
  std::vector<PointPair> pairs = MakePairs(40, 0, 3);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].point_in_source = pairs[i].point_in_target =
        Eigen::Vector3d(0, 0, 1 + 0.1 * static_cast<double>(i));
  }
  EXPECT_FALSE(Align(pairs));
}

TEST(PointPairAlignment, TheSameEngineGivesTheSameBits) {
  const std::vector<PointPair> pairs = MakePairs(80, 40, 4);
  const auto a = Align(pairs), b = Align(pairs);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->target_from_source.translation(), b->target_from_source.translation());
  EXPECT_EQ(a->inlier, b->inlier);
}

TEST(PointPairAlignment, RefusesFewerThanThreeInliers) {
  EXPECT_THROW(Align(MakePairs(10, 0, 0), 2), std::logic_error);
}

}  // namespace
}  // namespace ofm
