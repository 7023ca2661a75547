#include "ofm/dynamics/mask_refinement.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace ofm {
namespace {

/// A person at 1.5 m in front of a wall at 3 m.
struct Scene {
  cv::Size size = {320, 240};
  cv::Rect person = {100, 40, 80, 180};
  cv::Mat depth_m = cv::Mat(size, CV_32FC1, cv::Scalar(3));

  Scene() { depth_m(person).setTo(1.5F); }
  cv::Mat MaskOf(const cv::Rect& rectangle) const {
    cv::Mat mask = cv::Mat::zeros(size, CV_8UC1);
    mask(rectangle).setTo(255);
    return mask;
  }
  cv::Mat Truth() const { return MaskOf(person); }
};

double Iou(const cv::Mat& a, const cv::Mat& b) {
  return cv::countNonZero(a & b) / static_cast<double>(cv::countNonZero(a | b));
}

TEST(MaskRefinement, BackgroundInAMaskGoes) {
  const Scene scene;
  const cv::Mat mask = scene.MaskOf({80, 30, 115, 205});
  const RefinedMask refined = RefineMask(mask, scene.depth_m, {.growth_px = 12});
  EXPECT_EQ(refined.verdict, MaskVerdict::kRefined);
  EXPECT_LT(Iou(mask, scene.Truth()), 0.65);
  EXPECT_GT(Iou(refined.mask, scene.Truth()), 0.95);
}

TEST(MaskRefinement, MissingLimbsAreFound) {
  const Scene scene;
  const cv::Mat mask = scene.MaskOf({108, 48, 64, 164});
  const RefinedMask refined =
      RefineMask(mask, scene.depth_m, {.growth_px = 12, .max_growth_share = 0.5});
  EXPECT_LT(Iou(mask, scene.Truth()), 0.75);
  EXPECT_GT(Iou(refined.mask, scene.Truth()), 0.97);
}

TEST(MaskRefinement, GrowthIsBounded) {
  Scene scene;
  scene.depth_m.setTo(1.5F);  // the person leans on a wall
  const RefinedMask refined = RefineMask(scene.Truth(), scene.depth_m, {.growth_px = 8});
  const cv::Rect reach(scene.person.x - 10, scene.person.y - 10, scene.person.width + 20,
                       scene.person.height + 20);
  EXPECT_EQ(cv::countNonZero(refined.mask & ~scene.MaskOf(reach)), 0);
  EXPECT_LT(cv::countNonZero(refined.mask), 1.35 * cv::countNonZero(scene.Truth()));
}

/// One who leans forward, his head 0.7 m nearer than his feet.
TEST(MaskRefinement, APersonWhoSpansMoreThanTheMarginStaysWhole) {
  Scene scene;
  for (int y = 0; y < scene.person.height; ++y) {
    const float here_m =
        1.2F + 0.7F * static_cast<float>(y) / static_cast<float>(scene.person.height);
    scene.depth_m(cv::Rect(scene.person.x, scene.person.y + y, scene.person.width, 1))
        .setTo(here_m);
  }
  EXPECT_GT(Iou(RefineMask(scene.Truth(), scene.depth_m, {}).mask, scene.Truth()), 0.97);
}

/// An arm held towards the camera is a surface of its own.
TEST(MaskRefinement, AnArmALittleNearerStays) {
  Scene scene;
  scene.depth_m(cv::Rect(110, 90, 60, 20)).setTo(1.25F);
  EXPECT_GT(Iou(RefineMask(scene.Truth(), scene.depth_m, {}).mask, scene.Truth()), 0.97);
}

TEST(MaskRefinement, WithoutDepthTheMaskStaysAsItWas) {
  const Scene scene;
  cv::Mat depth_m = scene.depth_m.clone();
  depth_m(scene.person).setTo(0);
  const RefinedMask refined = RefineMask(scene.Truth(), depth_m, {});
  EXPECT_EQ(refined.verdict, MaskVerdict::kUnmeasured);
  EXPECT_EQ(cv::countNonZero(refined.mask != scene.Truth()), 0);
}

TEST(MaskRefinement, HolesInTheDepthStayInTheMask) {
  Scene scene;
  scene.depth_m(cv::Rect(100, 40, 80, 40)).setTo(0);  // dark hair
  const RefinedMask refined = RefineMask(scene.Truth(), scene.depth_m, {});
  EXPECT_EQ(refined.verdict, MaskVerdict::kRefined);
  EXPECT_GT(Iou(refined.mask, scene.Truth()), 0.97);
}

TEST(MaskRefinement, AMaskOverNearlyTheWholeImageIsNotBelieved) {
  const Scene scene;
  const cv::Mat all(scene.size, CV_8UC1, cv::Scalar(255));
  const RefinedMask refined = RefineMask(all, scene.depth_m, {});
  EXPECT_EQ(refined.verdict, MaskVerdict::kDistrusted);
  EXPECT_EQ(cv::countNonZero(refined.mask), 0);
  EXPECT_EQ(RefineMask(scene.MaskOf({0, 0, 320, 190}), scene.depth_m, {}).verdict,
            MaskVerdict::kRefined)
      << "80 % may be true";
}

TEST(MaskRefinement, NothingStaysNothing) {
  const Scene scene;
  const cv::Mat none = cv::Mat::zeros(scene.size, CV_8UC1);
  EXPECT_EQ(cv::countNonZero(RefineMask(none, scene.depth_m, {}).mask), 0);
}

TEST(MaskRefinement, TheMaskGivenIsNotTouched) {
  const Scene scene;
  const cv::Mat mask = scene.MaskOf({80, 30, 115, 205}), before = mask.clone();
  RefineMask(mask, scene.depth_m, {});
  EXPECT_EQ(cv::countNonZero(mask != before), 0);
}

TEST(MaskRefinement, DepthOfAnotherSizeIsAProgrammersError) {
  const Scene scene;
  EXPECT_THROW(RefineMask(scene.Truth(), cv::Mat::zeros(24, 32, CV_32FC1), {}), std::logic_error);
}

}  // namespace
}  // namespace ofm
