#include "ofm/objects/object_hypothesis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ofm/objects/test_patch.h"

namespace ofm {
namespace {

using test::Patch;

ObjectHypothesis Of(const std::vector<PlacedObservation>& observations) {
  ObjectHypothesis hypothesis(.04);
  for (const PlacedObservation& observation : observations) hypothesis.Add(observation);
  return hypothesis;
}

TEST(ObjectHypothesis, SharesWhatItsNoiseAllows) {
  const ObjectHypothesis whole = Of({Patch(0, 1, 0, 0.4)}), half = Of({Patch(1, 1, 0, 0.2)});
  EXPECT_DOUBLE_EQ(half.ShareIn(whole), 1);
  EXPECT_NEAR(whole.ShareIn(half), .6, .1);
  EXPECT_DOUBLE_EQ(Of({Patch(0, 1, 0, .2, .04)}).ShareIn(half), 1) << "one voxel behind";
  EXPECT_DOUBLE_EQ(Of({Patch(0, 1, 0, .2, .12)}).ShareIn(half), 0) << "three voxels behind";
  EXPECT_FALSE(half.IsNear(Of({Patch(0, 1, .6, .8)})));
  EXPECT_DOUBLE_EQ(half.ShareIn(Of({})), 0);
}

TEST(ObjectHypothesis, OneWrongMaskOfManyDoesNotCount) {
  std::vector<PlacedObservation> seen;
  for (std::uint32_t id = 0; id < 10; ++id) seen.push_back(Patch(id, 1, 0, .2));
  seen.push_back(Patch(10, 1, 0, .8));
  const ObjectHypothesis object = Of(seen);
  EXPECT_EQ(object.Size(), Of({Patch(0, 1, 0, .2)}).Size());
  EXPECT_EQ(object.Centers().size(), static_cast<std::size_t>(object.Size()));
  EXPECT_DOUBLE_EQ(Of({Patch(0, 1, .4, .8)}).ShareIn(object), 0);
  for (const Eigen::Vector3f& point : object.Points()) EXPECT_LT(point.x(), .24F);
}

TEST(ObjectHypothesis, KnowsItsPlaceAndSpread) {
  const Spread spread = Of({Patch(0, 1, 0, .4)}).FindSpread();
  EXPECT_LT((spread.center - Eigen::Vector3d(.2, .1, 1.02)).norm(), .01);
  EXPECT_NEAR(spread.radius_m, std::sqrt((.4 * .4 + .2 * .2) / 12), .01);
  EXPECT_EQ(Of({}).FindSpread().radius_m, 0);
}

TEST(ObjectHypothesis, SumsWhatTheClassesScored) {
  ObjectHypothesis object = Of({Patch(0, 7, 0, .2), Patch(0, 5, 0, .2), Patch(1, 5, 0, .2)});
  EXPECT_EQ(object.BestClass(), ClassId(5));
  EXPECT_TRUE(object.IsLikely(ClassId(7)));
  EXPECT_FALSE(object.IsLikely(ClassId(1)));
  EXPECT_NEAR(object.Weight(), 2.4, 1e-6);
  EXPECT_EQ(object.views().size(), 2U) << "two instances in one key frame are one view";
  EXPECT_TRUE(object.SawIn(KeyframeId(0), ClassId(7)));
  EXPECT_FALSE(object.SawIn(KeyframeId(1), ClassId(7)));
  object.Absorb(Of({Patch(2, 7, 0, .2), Patch(3, 7, 0, .2)}));
  EXPECT_EQ(object.BestClass(), ClassId(7));
  EXPECT_EQ(object.views().size(), 4U);
  EXPECT_FALSE(Of({}).BestClass().valid());
}

}  // namespace
}  // namespace ofm
