#include "ofm/dense/voxel_table.h"

#include <gmock/gmock.h>

#include <limits>

namespace ofm {
namespace {

TEST(FindVoxel, RoundsDownOnBothSidesOfZero) {
  EXPECT_EQ(FindVoxel({.04f, -.01f, .051f}, 20), VoxelIndex(0, -1, 1));
  EXPECT_EQ(FindVoxel({0, -.0499f, -.0501f}, 20), VoxelIndex(0, -1, -2));
}

TEST(FindVoxel, NothingBeyondTheGridOrNotFinite) {
  EXPECT_EQ(FindVoxel({1638.3f, 0, 0}, 20), VoxelIndex(32766, 0, 0));
  EXPECT_FALSE(FindVoxel({1638.5f, 0, 0}, 20));
  EXPECT_FALSE(FindVoxel({0, -1e30f, 0}, 20));
  EXPECT_FALSE(FindVoxel({0, 0, std::numeric_limits<float>::quiet_NaN()}, 20));
  EXPECT_FALSE(FindVoxel({0, 0, std::numeric_limits<float>::infinity()}, 20));
}

TEST(FindVoxel, TheCenterOfAVoxelIsInIt) {
  for (const VoxelIndex& voxel : {VoxelIndex(0, 0, 0), VoxelIndex(-1, 7, 200)}) {
    EXPECT_EQ(FindVoxel(VoxelCenter(voxel, .05), 20), voxel);
  }
}

TEST(VoxelTable, NumbersVoxelsInTheOrderTheyCome) {
  VoxelTable table;
  EXPECT_EQ(table.Insert({5, 5, 5}), 0u);
  EXPECT_EQ(table.Insert({-1, 0, 0}), 1u);
  EXPECT_EQ(table.Insert({5, 5, 5}), 0u);
  EXPECT_EQ(table.size(), 2u);
  EXPECT_EQ(table.At(1), VoxelIndex(-1, 0, 0));
  EXPECT_FALSE(table.Find({0, 0, 0}));
}

TEST(VoxelTable, ManyVoxelsKeepTheirNumbers) {
  VoxelTable table;
  const auto voxel = [](int i) {
    return VoxelIndex(i % 23 - 11, i / 23 % 19 - 32768, 32767 - i / 437);
  };
  for (int i = 0; i < 20000; ++i) ASSERT_EQ(table.Insert(voxel(i)), static_cast<unsigned>(i));
  for (int i = 0; i < 20000; ++i) {
    ASSERT_EQ(table.Find(voxel(i)), static_cast<unsigned>(i));
    ASSERT_EQ(table.At(i), voxel(i));
  }
  EXPECT_FALSE(table.Find({100, 0, 0}));
}

TEST(VoxelTable, SortedNumbersDoNotDependOnTheOrderOfInsertion) {
  VoxelTable table;
  for (const VoxelIndex& v : {VoxelIndex(1, 0, 0), VoxelIndex(0, 0, 1), VoxelIndex(0, -1, 9)}) {
    table.Insert(v);
  }
  EXPECT_THAT(table.SortedNumbers(), testing::ElementsAre(2, 1, 0));
}

}  // namespace
}  // namespace ofm
