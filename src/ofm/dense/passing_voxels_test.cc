#include "ofm/dense/passing_voxels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ofm/dense/octree_integrator.h"
#include "ofm/dense/semantic_mapper.h"
#include "ofm/dense/test_scene.h"

namespace ofm {
namespace {

using test::Box, test::Render, test::SmallCamera, test::Wall;

/// Up is against y, as the cameras look along z.
Box Floor() { return {{-4, .82, .5}, {4, 1, 4}, test::kGrey}; }
/// Somebody's trunk, `x` metres to the right.
Box Trunk(double x) { return {{x - .2, -.6, 1.52}, {x + .2, .1, 1.7}, {10, 200, 10}, 0, true}; }
/// Under Trunk(0), and in no mask.
Box Feet() { return {{-.12, .3, 1.56}, {.12, .5, 1.66}, test::kRed}; }
const Eigen::Vector3f kFeetPlace(.02f, .4f, 1.575f);

/// Key frames of a camera at rest that see these boxes, `interval_s` apart.
class Recording {
 public:
  explicit Recording(double interval_s, const DenseOptions& options = {})
      : interval_s_(interval_s), options_(options), mapper_(SmallCamera(), options) {}

  Recording& Add(const std::vector<Box>& boxes, int times) {
    for (int i = 0; i < times; ++i) {
      LabelledFrame frame = Render(SmallCamera(), boxes, {}, KeyframeId(count_));
      frame.stamp_ns = static_cast<std::int64_t>(1e9 * interval_s_ * count_);
      mapper_.AddKeyframe(frame);
      poses_[KeyframeId(count_++)] = RigidTransform();
    }
    return *this;
  }

  SemanticMap Map() const { return mapper_.Build(poses_); }
  std::vector<VoxelIndex> Passing() const {
    OctreeIntegrator integrator(options_);
    integrator.Update(mapper_.clouds(), poses_, 0);
    return FindPassingVoxels(integrator.octree(), mapper_.clouds(), poses_, options_);
  }

 private:
  double interval_s_;
  DenseOptions options_;
  SemanticMapper mapper_;
  KeyframePoseMap poses_;
  std::uint32_t count_ = 0;
};

/// Nothing is doubted for being at the border.
DenseOptions WithoutBorder() {
  DenseOptions options;
  options.passing.border_share = 0;
  return options;
}

TEST(PassingVoxels, FeetUnderSomebodyAreFoundAndNothingElse) {
  const std::vector<VoxelIndex> passing =
      Recording(.3, WithoutBorder()).Add({Wall(), Floor(), Trunk(0), Feet()}, 2).Passing();
  ASSERT_GT(passing.size(), 10u);
  for (const VoxelIndex& voxel : passing) {
    const Eigen::Vector3f center = VoxelCenter(voxel, .05);
    EXPECT_NEAR(center.z(), 1.6, .07);
    EXPECT_NEAR(center.y(), .4, .15);
  }
}

TEST(PassingVoxels, TheyAreInNeitherOctreeNorCloud) {
  const SemanticMap map = Recording(.3).Add({Wall(), Floor(), Trunk(0), Feet()}, 2).Map();
  EXPECT_FALSE(map.octree.Find(kFeetPlace));
  EXPECT_TRUE(std::ranges::none_of(
      map.cloud_in_world, [](const LabelledPoint& point) { return point.position.z() < 1.7; }));
  EXPECT_TRUE(map.octree.IsOccupied({.7f, 0, 3.025f}));
}

TEST(PassingVoxels, WhatWasSeenForLongOrOftenOrBesideNobodyStays) {
  const std::vector<Box> somebody{Wall(), Floor(), Trunk(0), Feet()};
  EXPECT_TRUE(Recording(1.1).Add(somebody, 2).Map().octree.IsOccupied(kFeetPlace));
  EXPECT_TRUE(Recording(.3).Add(somebody, 3).Map().octree.IsOccupied(kFeetPlace));
  const std::vector<Box> elsewhere{Wall(), Floor(), Trunk(.6), Feet()};
  EXPECT_TRUE(Recording(.3).Add(elsewhere, 2).Map().octree.IsOccupied(kFeetPlace));
  EXPECT_TRUE(Recording(.3, WithoutBorder()).Add({Wall(), Floor(), Feet()}, 2).Passing().empty());
}

TEST(PassingVoxels, SomebodyWhoPassedBeforeOrAfterIsNotBeside) {
  const std::vector<Box> alone{Wall(), Floor(), Feet()};
  const std::vector<Box> beside{Wall(), Floor(), Trunk(0)};
  EXPECT_TRUE(Recording(.3).Add(alone, 2).Add(beside, 1).Map().octree.IsOccupied(kFeetPlace));
}

TEST(PassingVoxels, WhatTheBorderAloneShowedIsFoundUntilItIsSeenForLong) {
  // The camera sees 1.85 m to the right on the wall; a border of .1 hides what is beyond 1.48 m.
  DenseOptions options;
  options.passing.border_share = .1;
  const auto is_mapped = [&](double interval_s, float x) {
    return Recording(interval_s, options)
        .Add({Wall()}, 2)
        .Map()
        .octree.IsOccupied({x, .02f, 3.025f});
  };
  EXPECT_FALSE(is_mapped(.3, 1.72f));
  EXPECT_TRUE(is_mapped(.3, 1.22f));
  EXPECT_TRUE(is_mapped(1.1, 1.72f));  // a camera at rest maps its whole image
}

TEST(PassingVoxels, NothingIsFoundWithoutAHorizontalPlaneOrWhenSwitchedOff) {
  const std::vector<Box> in_the_air{Wall(), Trunk(0), Feet()};
  EXPECT_TRUE(Recording(.3, WithoutBorder()).Add(in_the_air, 2).Passing().empty());
  DenseOptions options;
  options.passing.min_seen_s = 0;
  EXPECT_TRUE(Recording(.3, options).Add({Wall(), Floor(), Trunk(0), Feet()}, 2).Passing().empty());
}

}  // namespace
}  // namespace ofm
