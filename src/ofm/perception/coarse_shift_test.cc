#include "ofm/perception/coarse_shift.h"

#include <gtest/gtest.h>

#include "ofm/perception/carry_test_support.h"

namespace ofm {
namespace {

using test::CarryScene;

CoarseShift Find(const CarryScene& scene, cv::Point2f from, cv::Point2f to,
                 const CoarseSearch& search = {}) {
  return FindCoarseShift(scene.MakeInstance(from), scene.Flow(0, from), scene.Flow(1, to), search);
}

TEST(CoarseShift, FindsALargeShiftToAPixelOfTheCoarsestLevel) {
  for (const cv::Point2f shift : {cv::Point2f(64, -16), cv::Point2f(-40, 24), cv::Point2f(0, 0)}) {
    const cv::Point2f start(150, 120);
    const CoarseShift found = Find({}, start, start + shift);
    EXPECT_NEAR(found.shift_px.x(), shift.x, 8);
    EXPECT_NEAR(found.shift_px.y(), shift.y, 8);
    EXPECT_GT(found.agreement, 0.8);
  }
}

TEST(CoarseShift, FindsAPlainObjectByItsOutlineInDepth) {
  const CoarseShift found = Find({.is_plain = true}, {120, 120}, {184, 120});
  EXPECT_NEAR(found.shift_px.x(), 64, 8);
  EXPECT_NEAR(found.shift_px.y(), 0, 16);
}

TEST(CoarseShift, FindsAnObjectWithoutDepthByItsGreyLevels) {
  const CoarseShift found = Find({.measures_depth = false}, {120, 120}, {168, 104});
  EXPECT_NEAR(found.shift_px.x(), 48, 8);
  EXPECT_NEAR(found.shift_px.y(), -16, 8);
  EXPECT_EQ(found.agreement, 0);
}

TEST(CoarseShift, TellsThatTheObjectIsNotThere) {
  const CarryScene scene;
  const cv::Point2f place(150, 120), far_outside(150, 900);
  const CoarseShift found = FindCoarseShift(scene.MakeInstance(place), scene.Flow(0, place),
                                            scene.Flow(1, far_outside), {});
  EXPECT_LT(found.agreement, 0.2);
}

TEST(CoarseShift, LooksAroundTheExpectedPlace) {
  const CarryScene scene{.size = {640, 240}};
  const cv::Point2f start(120, 120), end(400, 120);
  EXPECT_NEAR(Find(scene, start, end, {{260, 0}, 40}).shift_px.x(), 280, 8);
  EXPECT_LT(Find(scene, start, end, {{0, 0}, 40}).shift_px.x(), 50);
}

TEST(CoarseShift, StaysWithinReach) {
  const CoarseShift found = Find({}, {80, 120}, {200, 120}, {{0, 0}, 32});
  EXPECT_LE(std::abs(found.shift_px.x()), 40);
}

TEST(CoarseShift, PyramidsOfDifferentSizesAreAProgrammersError) {
  const CarryScene scene, other{.size = {160, 120}};
  EXPECT_THROW(FindCoarseShift(scene.MakeInstance({80, 60}), scene.Flow(0, {80, 60}),
                               other.Flow(1, {80, 60}), {}),
               std::logic_error);
}

}  // namespace
}  // namespace ofm
