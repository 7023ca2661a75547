#include "ofm/objects/depth_sketch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ofm/dense/test_scene.h"

namespace ofm {
namespace {

using test::At;
using test::SmallCamera;

/// A wall at 2 m, with a hole in the measurements on the left.
DepthSketch WallAhead() {
  cv::Mat depth(120, 160, CV_32FC1, cv::Scalar(2));
  depth(cv::Rect(0, 0, 40, 120)).setTo(std::numeric_limits<float>::quiet_NaN());
  return SketchDepth(depth);
}

PointSight SightOf(const Eigen::Vector3f& point, const RigidTransform& camera_from_world = {}) {
  const std::vector<Eigen::Vector3f> points{point};
  return FindSight(points, camera_from_world, WallAhead(), SmallCamera(), {});
}

TEST(DepthSketch, HasEveryEighthPixelAndZeroWhereNothingWasMeasured) {
  const DepthSketch sketch = WallAhead();
  EXPECT_EQ(sketch.columns, 20);
  EXPECT_EQ(sketch.rows, 15);
  EXPECT_EQ(sketch.At(4, 3), 0);
  EXPECT_EQ(sketch.At(5, 3), 2);
}

TEST(FindSight, TellsWhatIsVisibleHiddenAndSeenThrough) {
  EXPECT_EQ(SightOf({0, 0, 2.05F}).visible, 1);
  EXPECT_EQ(SightOf({0, 0, 2.5F}).hidden, 1);
  EXPECT_EQ(SightOf({0, 0, 1.5F}).seen_through, 1);
  EXPECT_EQ(SightOf({0, 0, 2.5F}, At(0, 0, -.5)).visible, 1) << "from farther ahead";
}

TEST(FindSight, SaysNothingOfWhatIsOutOfSightOrNotMeasured) {
  for (const Eigen::Vector3f& point :
       {Eigen::Vector3f(0, 0, -2), Eigen::Vector3f(0, 0, .05F), Eigen::Vector3f(5, 0, 2),
        Eigen::Vector3f(0, .88F, 2), Eigen::Vector3f(-.8F, 0, 2), Eigen::Vector3f(900, 0, 2)}) {
    const PointSight sight = SightOf(point);
    EXPECT_EQ(sight.visible + sight.hidden + sight.seen_through, 0) << point.transpose();
  }
}

}  // namespace
}  // namespace ofm
