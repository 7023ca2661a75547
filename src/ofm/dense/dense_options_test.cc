#include "ofm/dense/dense_options.h"

#include <gmock/gmock.h>

#include <cmath>

#include "ofm/base/error.h"

namespace ofm {
namespace {

TEST(DenseOptions, DefaultsAreValid) { EXPECT_NO_THROW(CheckOptions(DenseOptions())); }

TEST(DenseOptions, CloudVoxelsAreHalfAnOctreeVoxelByDefault) {
  EXPECT_DOUBLE_EQ(DenseOptions().CloudResolution(), .025);
}

TEST(DenseOptions, ImpossibleResolutionsAreRejectedByName) {
  for (const double resolution : {0., -.05, 10., std::nan("")}) {
    DenseOptions options;
    options.resolution_m = resolution;
    try {
      CheckOptions(options);
      FAIL() << resolution;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("dense.resolution_m"));
    }
  }
}

TEST(DenseOptions, ASensorModelThatNeverClearsIsRejected) {
  DenseOptions options;
  options.occupancy.probability_miss = .5;
  EXPECT_THROW(CheckOptions(options), Error);
}

TEST(DenseOptions, ANavigationBandWithoutHeightIsRejected) {
  DenseOptions options;
  options.navigation.min_height_m = options.navigation.max_height_m;
  EXPECT_THROW(CheckOptions(options), Error);
}

TEST(DenseOptions, NestedFieldsAreSetByTheirPaths) {
  DenseOptions options;
  const auto fields = OptionFields(options);
  ApplyOptionAssignment("cloud.mask_margin_px=7", fields);
  ApplyOptionAssignment("occupancy.probability_hit=.8", fields);
  EXPECT_EQ(options.cloud.mask_margin_px, 7);
  EXPECT_DOUBLE_EQ(options.occupancy.probability_hit, .8);
  EXPECT_THROW(ApplyOptionAssignment("resolution_m=0", fields), Error);
}

}  // namespace
}  // namespace ofm
