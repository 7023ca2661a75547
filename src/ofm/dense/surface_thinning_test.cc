#include "ofm/dense/surface_thinning.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ofm {
namespace {

constexpr double kSpacing_m = .01;

/// A piece of a wall, seen from the origin, square to z, a point in each voxel.
void AddLayer(float z_m, float precision, std::vector<FusedVoxel>& voxels,
              std::uint8_t class_id = kNoLabel) {
  for (int x = -10; x < 10; ++x) {
    for (int y = -10; y < 10; ++y) {
      FusedVoxel voxel;
      voxel.point.position = {(static_cast<float>(x) + .5F) * .01F,
                              (static_cast<float>(y) + .5F) * .01F, z_m};
      voxel.point.precision = precision;
      voxel.point.class_id = class_id;
      voxel.precision = precision;
      voxels.push_back(voxel);
    }
  }
}

TEST(ThinSurfaces, LayersBecomeOneSurfaceAtTheirMean) {
  std::vector<FusedVoxel> voxels;
  AddLayer(.985F, 1e4F, voxels);
  AddLayer(.995F, 2e4F, voxels);
  AddLayer(1.005F, 1e4F, voxels);
  const std::vector<LabelledPoint> points = ThinSurfaces(voxels, kSpacing_m);
  // The outermost lines of sight leave the piece.
  EXPECT_NEAR(static_cast<double>(points.size()), 400, 40);
  for (const LabelledPoint& point : points) EXPECT_NEAR(point.position.z(), .995, .002);
}

TEST(ThinSurfaces, SurfacesFarApartStayWhatTheyAre) {
  std::vector<FusedVoxel> voxels;
  AddLayer(.905F, 1e4F, voxels);
  AddLayer(1.005F, 1e5F, voxels);
  const std::vector<LabelledPoint> points = ThinSurfaces(voxels, kSpacing_m);
  ASSERT_EQ(points.size(), 800u);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(points[i].position.z(), i < 400 ? .905 : 1.005, 1e-4);
  }
}

TEST(ThinSurfaces, APointHasTheLabelOfWhatIsSurest) {
  std::vector<FusedVoxel> voxels;
  AddLayer(.991F, 1e4F, voxels, 3);
  AddLayer(1.001F, 4e4F, voxels, 7);
  const std::vector<LabelledPoint> points = ThinSurfaces(voxels, kSpacing_m);
  const auto sevens = std::count_if(points.begin(), points.end(),
                                    [](const LabelledPoint& p) { return p.class_id == 7; });
  EXPECT_GT(static_cast<double>(sevens), .9 * static_cast<double>(points.size()));
}

TEST(ThinSurfaces, APointAtItsViewpointStaysAndNothingBecomesNothing) {
  FusedVoxel voxel;
  voxel.point.position = voxel.viewpoint = {1, 2, 3};
  voxel.precision = 1;
  const std::vector<LabelledPoint> points = ThinSurfaces(std::vector{voxel}, kSpacing_m);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].position, voxel.point.position);
  EXPECT_TRUE(ThinSurfaces({}, kSpacing_m).empty());
}

}  // namespace
}  // namespace ofm
