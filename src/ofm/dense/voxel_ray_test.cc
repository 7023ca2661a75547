#include "ofm/dense/voxel_ray.h"

#include <gmock/gmock.h>

namespace ofm {
namespace {

std::vector<VoxelIndex> Crossed(const Eigen::Vector3f& origin, const Eigen::Vector3f& end) {
  std::vector<VoxelIndex> voxels;
  TraverseRay(origin, end, .1, [&](const VoxelIndex& voxel) { voxels.push_back(voxel); });
  return voxels;
}

TEST(TraverseRay, AStraightRayCrossesAllVoxelsButTheLast) {
  EXPECT_THAT(Crossed({.05f, .05f, .05f}, {.35f, .05f, .05f}),
              testing::ElementsAre(VoxelIndex(0, 0, 0), VoxelIndex(1, 0, 0), VoxelIndex(2, 0, 0)));
}

TEST(TraverseRay, ARayMayGoBackwardsThroughZero) {
  EXPECT_THAT(Crossed({.05f, .05f, .15f}, {.05f, .05f, -.15f}),
              testing::ElementsAre(VoxelIndex(0, 0, 1), VoxelIndex(0, 0, 0), VoxelIndex(0, 0, -1)));
}

TEST(TraverseRay, NothingIsCrossedWithinOneVoxel) {
  EXPECT_THAT(Crossed({.01f, .01f, .01f}, {.09f, .02f, .03f}), testing::IsEmpty());
}

TEST(TraverseRay, EachStepOfAnObliqueRayCrossesOneFaceNearTheLine) {
  const Eigen::Vector3f origin(.03f, -.27f, .51f), end(1.91f, 2.33f, -1.07f);
  const std::vector<VoxelIndex> voxels = Crossed(origin, end);
  ASSERT_GT(voxels.size(), 50u);
  const Eigen::Vector3f direction = (end - origin).normalized();
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    if (i > 0) {
      EXPECT_EQ((voxels[i] - voxels[i - 1]).cwiseAbs().sum(), 1);
    }
    const Eigen::Vector3f offset = VoxelCenter(voxels[i], .1) - origin;
    EXPECT_LT((offset - offset.dot(direction) * direction).norm(), .0867f);  // half a diagonal
  }
  EXPECT_EQ((voxels.back() - *FindVoxel(end, 10)).cwiseAbs().sum(), 1);
}

}  // namespace
}  // namespace ofm
