#include "ofm/perception/mask_propagation.h"

#include <gtest/gtest.h>

#include "ofm/perception/carry_test_support.h"

namespace ofm {
namespace {

using test::CarryScene;
using test::Iou;

std::vector<CarriedInstance> Carry(const CarryScene& scene, cv::Point2f from, cv::Point2f to,
                                   const MaskPropagationOptions& options = {}) {
  const std::vector<CarriedInstance> before{{scene.MakeInstance(from)}};
  return CarryInstances(before, scene.Flow(0, from), scene.Flow(1, to), options, {});
}

TEST(MaskPropagation, CarriesAMovingObjectToItsNewPlace) {
  for (const cv::Point2f shift : {cv::Point2f(0, 0), cv::Point2f(7, -3), cv::Point2f(-60, 20)}) {
    const CarryScene scene{.wall_shift = {1, 2}};
    const cv::Point2f start(170, 110);
    const auto carried = Carry(scene, start, start + shift);
    ASSERT_EQ(carried.size(), 1U);
    EXPECT_GT(Iou(carried[0].instance.mask, scene.Mask(start + shift)), 0.93) << shift.x;
    EXPECT_EQ(carried[0].instance.box, cv::boundingRect(carried[0].instance.mask));
    EXPECT_EQ(carried[0].lost_s, 0);
    EXPECT_NEAR(carried[0].velocity_px_s.x(), shift.x / 0.033, 60);
  }
}

TEST(MaskPropagation, KeepsWhoItIs) {
  const auto carried = Carry({}, {150, 120}, {155, 120});
  ASSERT_EQ(carried.size(), 1U);
  EXPECT_EQ(carried[0].instance.id, InstanceId(3));
  EXPECT_EQ(carried[0].instance.class_id, ClassId(0));
  EXPECT_FLOAT_EQ(carried[0].instance.score, 0.8F);
}

TEST(MaskPropagation, TheInstancesGivenAreNotTouched) {
  const CarryScene scene;
  const std::vector<CarriedInstance> before{{scene.MakeInstance({150, 120})}};
  const cv::Mat mask = before[0].instance.mask.clone();
  CarryInstances(before, scene.Flow(0, {150, 120}), scene.Flow(1, {170, 120}), {}, {});
  EXPECT_EQ(cv::countNonZero(before[0].instance.mask != mask), 0);
}

TEST(MaskPropagation, APlainObjectIsCarriedByItsDepth) {
  const CarryScene scene{.is_plain = true};
  const auto carried = Carry(scene, {120, 120}, {168, 112});
  ASSERT_EQ(carried.size(), 1U);
  EXPECT_GT(Iou(carried[0].instance.mask, scene.Mask({168, 112})), 0.85);
}

TEST(MaskPropagation, AnObjectWithoutDepthIsCarriedByFlow) {
  const CarryScene scene{.measures_depth = false};
  const auto carried = Carry(scene, {120, 120}, {150, 112});
  ASSERT_EQ(carried.size(), 1U);
  EXPECT_GT(Iou(carried[0].instance.mask, scene.Mask({150, 112})), 0.9);
}

TEST(MaskPropagation, BackgroundInAMaskIsTrimmed) {
  const CarryScene scene;
  CarriedInstance before{scene.MakeInstance({150, 120})};
  cv::dilate(before.instance.mask, before.instance.mask, cv::Mat::ones(19, 19, CV_8UC1));
  before.instance.box = cv::boundingRect(before.instance.mask);
  const auto carried = CarryInstances(std::vector{before}, scene.Flow(0, {150, 120}),
                                      scene.Flow(1, {158, 120}), {}, {});
  ASSERT_EQ(carried.size(), 1U);
  EXPECT_LT(Iou(before.instance.mask, scene.Mask({150, 120})), 0.75);
  EXPECT_GT(Iou(carried[0].instance.mask, scene.Mask({158, 120})), 0.93);
}

TEST(MaskPropagation, WhatComesIntoViewJoinsTheMask) {
  const CarryScene scene;
  const auto carried = Carry(scene, {0, 120}, {30, 120});
  ASSERT_EQ(carried.size(), 1U);
  EXPECT_GT(Iou(carried[0].instance.mask, scene.Mask({30, 120})), 0.9);
}

TEST(MaskPropagation, AnObjectThatLeavesTheImageIsDropped) {
  CarryScene scene;
  const auto carried = Carry(scene, {18, 120}, {-60, 120}, {.max_lost_s = 0});
  EXPECT_TRUE(carried.empty());
}

/// The second frame has neither the object's texture nor its depth: it was covered.
TEST(MaskPropagation, WithoutFlowAnObjectGoesOnAsItWentForAWhile) {
  const CarryScene seen{.measures_depth = false};
  const CarryScene covered{.wall_m = 0, .is_plain = true, .measures_depth = false};
  FlowFrame to = covered.Flow(1, {150, 120});
  to.pyramid = BuildFlowPyramid(cv::Mat(covered.size, CV_8UC1, cv::Scalar(90)), {});
  CarriedInstance before{seen.MakeInstance({150, 120})};
  before.velocity_px_s = {300, 0};
  const auto carried = CarryInstances(std::vector{before}, seen.Flow(0, {150, 120}), to, {}, {});
  ASSERT_EQ(carried.size(), 1U);
  EXPECT_NEAR(carried[0].lost_s, 0.033, 1e-6);
  EXPECT_GT(Iou(carried[0].instance.mask, seen.Mask({160, 120})), 0.9);
  before.lost_s = 0.49;
  EXPECT_TRUE(CarryInstances(std::vector{before}, seen.Flow(0, {150, 120}), to, {}, {}).empty());
}

TEST(MaskPropagation, SameInputGivesTheSameMasks) {
  const auto a = Carry({}, {150, 120}, {171, 117}), b = Carry({}, {150, 120}, {171, 117});
  ASSERT_EQ(a.size(), 1U);
  EXPECT_EQ(cv::countNonZero(a[0].instance.mask != b[0].instance.mask), 0);
}

TEST(MaskPropagation, MaskOverTheWholeImageIsCarriedWithoutHarm) {
  const CarryScene scene;
  Instance all = scene.MakeInstance({150, 120});
  all.mask = cv::Mat(scene.size, CV_8UC1, cv::Scalar(255));
  all.box = {{}, scene.size};
  const auto carried = CarryInstances(std::vector<CarriedInstance>{{all}},
                                      scene.Flow(0, {150, 120}), scene.Flow(1, {160, 120}), {}, {});
  EXPECT_LE(carried.size(), 1U);
}

TEST(MaskPropagation, NoInstancesGiveNone) {
  const CarryScene scene;
  EXPECT_TRUE(
      CarryInstances({}, scene.Flow(0, {150, 120}), scene.Flow(1, {150, 120}), {}, {}).empty());
}

TEST(MaskPropagation, OddSizesWork) {
  const CarryScene scene{.size = {321, 241}};
  const auto carried = Carry(scene, {150, 120}, {160, 120});
  ASSERT_EQ(carried.size(), 1U);
  EXPECT_GT(Iou(carried[0].instance.mask, scene.Mask({160, 120})), 0.92);
}

TEST(MaskPropagation, FramesOfDifferentSizesAreAProgrammersError) {
  const CarryScene scene, other{.size = {160, 120}};
  EXPECT_THROW(CarryInstances({}, scene.Flow(0, {80, 60}), other.Flow(1, {80, 60}), {}, {}),
               std::logic_error);
}

}  // namespace
}  // namespace ofm
