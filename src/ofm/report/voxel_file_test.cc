#include "ofm/report/voxel_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "ofm/report/test_results.h"

namespace ofm {
namespace {

using testing::HasSubstr;

class LoadVoxelsTest : public testing::Test {
 protected:
  LoadVoxelsTest() { test::WriteMadeResults(folder_.path()); }

  VoxelSet Load(std::size_t max_voxels) const {
    return LoadVoxels(folder_.path() / "map.ot", folder_.path() / "map_labels.csv", max_voxels);
  }
  static std::size_t CountOf(const VoxelSet& set, std::uint8_t class_id) {
    return static_cast<std::size_t>(
        std::count_if(set.voxels.begin(), set.voxels.end(),
                      [&](const LabelledVoxel& voxel) { return voxel.class_id == class_id; }));
  }

  TestFolder folder_;
};

TEST_F(LoadVoxelsTest, ReadsOccupiedVoxelsWithTheirLabels) {
  const VoxelSet set = Load(100000);
  EXPECT_DOUBLE_EQ(set.resolution_m, 0.1);
  EXPECT_GT(set.voxels.size(), 300U);
  EXPECT_GT(CountOf(set, 1), 30U);
  EXPECT_EQ(CountOf(set, 1) + CountOf(set, kNoLabel), set.voxels.size());
  for (const LabelledVoxel& voxel : set.voxels) {
    EXPECT_EQ(voxel.size_exponent, 0);
    EXPECT_NEAR(voxel.color.r, 200, 1);
    EXPECT_LT(voxel.center.norm(), 4);
  }
}

TEST_F(LoadVoxelsTest, LeavesOutLevelsWhereThereAreTooMany) {
  const VoxelSet all = Load(100000), few = Load(100);
  EXPECT_LE(few.voxels.size(), 100U);
  EXPECT_GT(few.voxels.size(), 10U);
  EXPECT_GE(few.voxels.front().size_exponent, 1);
  EXPECT_GT(CountOf(few, 1), 3U);
  EXPECT_LT(few.voxels.size(), all.voxels.size());
}

TEST_F(LoadVoxelsTest, NeedsNoLabels) {
  std::filesystem::remove(folder_.path() / "map_labels.csv");
  const VoxelSet set = Load(100000);
  EXPECT_EQ(CountOf(set, kNoLabel), set.voxels.size());
}

TEST_F(LoadVoxelsTest, SaysWhatIsWrongAndWhere) {
  const auto error = [&](const char* labels) {
    folder_.Write("map_labels.csv", std::string("x,y,z,class_id,class,confidence\n") + labels);
    return ErrorOf([&] { Load(10); });
  };
  EXPECT_THAT(error("1,2\n"), HasSubstr("map_labels.csv:2: has fewer fields"));
  EXPECT_THAT(error("1,2,a,1,chair,1\n"), HasSubstr("map_labels.csv:2: 'a'"));
  EXPECT_THAT(error("1,2,3,256,chair,1\n"), HasSubstr("not in 0 to 255"));
  EXPECT_THAT(error("1e9,2,3,1,chair,1\n"), HasSubstr("outside"));
  folder_.Write("map.ot", "nothing");
  EXPECT_THAT(ErrorOf([&] { Load(10); }), HasSubstr("map.ot: is no OctoMap file"));
}

}  // namespace
}  // namespace ofm
