#include "ofm/perception/mask_propagation.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

#include "ofm/perception/carry_test_support.h"
#include "ofm/perception/cell_origins.h"

namespace ofm {
namespace {

using test::CarryScene;
using test::Iou;

/// An instance of the frame where the object is at `from`, in the one where it is at `to`.
std::vector<Instance> Carry(const CarryScene& scene, Instance instance, cv::Point2f from,
                            cv::Point2f to, const MaskPropagationOptions& options = {}) {
  LatticeFlow flow(scene.camera(), {});
  const LatticeStep before = flow.Process(scene.Frame(0, from));
  const RgbdFrame frame = scene.Frame(1, to);
  const LatticeStep now = flow.Process(frame);
  const MaskPropagation propagation(flow.lattice().cells(), options);
  const cv::Mat origins =
      CarryOrigins(OwnOrigins(flow.lattice().size()), before.frame.depth_m, now);
  return propagation.Carry(propagation.Prepare({std::move(instance)}, before.frame.depth_m),
                           {origins, now.frame.depth_m, frame.depth_m, 0.033});
}

std::vector<Instance> Carry(const CarryScene& scene, cv::Point2f from, cv::Point2f to) {
  return Carry(scene, scene.MakeInstance(from), from, to);
}

TEST(MaskPropagation, CarriesAMovingObjectToItsNewPlace) {
  for (const cv::Point2f shift : {cv::Point2f(0, 0), cv::Point2f(7, -3), cv::Point2f(-30, 10)}) {
    const CarryScene scene{.wall_shift = {1, 2}};
    const cv::Point2f start(170, 110);
    const auto carried = Carry(scene, start, start + shift);
    ASSERT_EQ(carried.size(), 1U);
    EXPECT_GT(Iou(carried[0].mask, scene.Mask(start + shift)), 0.95) << shift.x;
    EXPECT_EQ(carried[0].box, cv::boundingRect(carried[0].mask));
  }
}

TEST(MaskPropagation, KeepsWhoItIs) {
  const auto carried = Carry({}, {150, 120}, {155, 120});
  ASSERT_EQ(carried.size(), 1U);
  EXPECT_EQ(carried[0].id, InstanceId(3));
  EXPECT_EQ(carried[0].class_id, ClassId(0));
  EXPECT_FLOAT_EQ(carried[0].score, 0.8F);
}

TEST(MaskPropagation, TheInstancesGivenAreNotTouched) {
  const CarryScene scene;
  const Instance before = scene.MakeInstance({150, 120});
  const cv::Mat mask = before.mask.clone();
  Carry(scene, before, {150, 120}, {170, 120});
  EXPECT_EQ(cv::countNonZero(before.mask != mask), 0);
}

TEST(MaskPropagation, APlainObjectEndsWhereItsDepthDoes) {
  const CarryScene scene{.is_plain = true};
  const auto carried = Carry(scene, {120, 120}, {130, 116});
  ASSERT_EQ(carried.size(), 1U);
  EXPECT_GT(Iou(carried[0].mask, scene.Mask({130, 116})), 0.93);
}

TEST(MaskPropagation, AnObjectWithoutDepthIsCarriedByFlow) {
  const CarryScene scene{.measures_depth = false};
  const auto carried = Carry(scene, {120, 120}, {126, 118});
  ASSERT_EQ(carried.size(), 1U);
  EXPECT_GT(Iou(carried[0].mask, scene.Mask({126, 118})), 0.8);
}

TEST(MaskPropagation, BackgroundInAMaskIsTrimmed) {
  const CarryScene scene;
  Instance before = scene.MakeInstance({150, 120});
  cv::dilate(before.mask, before.mask, cv::Mat::ones(19, 19, CV_8UC1));
  ASSERT_LT(Iou(before.mask, scene.Mask({150, 120})), 0.75);
  const auto carried = Carry(scene, before, {150, 120}, {158, 120});
  ASSERT_EQ(carried.size(), 1U);
  EXPECT_GT(Iou(carried[0].mask, scene.Mask({158, 120})), 0.95);
  const auto untrimmed =
      Carry(scene, before, {150, 120}, {158, 120}, {.depth_margin_m = 10, .growth_px = 0});
  EXPECT_LT(Iou(untrimmed.at(0).mask, scene.Mask({158, 120})), 0.85);
}

TEST(MaskPropagation, WhatComesIntoViewJoinsTheMask) {
  const CarryScene scene;
  const auto carried = Carry(scene, {10, 120}, {30, 120});
  ASSERT_EQ(carried.size(), 1U);
  EXPECT_GT(Iou(carried[0].mask, scene.Mask({30, 120})), 0.9);
}

TEST(MaskPropagation, HolesAreClosedAndScatteredPartsDropped) {
  const CarryScene scene;
  Instance before = scene.MakeInstance({150, 120});
  before.mask(cv::Rect(140, 110, 12, 12)) = 0;
  before.mask(cv::Rect(280, 20, 16, 16)) = 255;
  const auto carried = Carry(scene, before, {150, 120}, {154, 120}, {.growth_px = 0});
  ASSERT_EQ(carried.size(), 1U);
  EXPECT_GT(Iou(carried[0].mask, scene.Mask({154, 120})), 0.95);
}

TEST(MaskPropagation, AnObjectThatIsGoneIsDropped) {
  const CarryScene scene;
  Instance speck = scene.MakeInstance({150, 120});
  speck.mask.setTo(0);
  speck.mask(cv::Rect(148, 118, 4, 4)) = 255;
  EXPECT_TRUE(Carry(scene, speck, {150, 120}, {150, 120}, {.growth_px = 0}).empty());
  EXPECT_TRUE(Carry(scene, {6, 120}, {-60, 120}).empty());
}

TEST(MaskPropagation, SameInputGivesTheSameMasks) {
  const auto a = Carry({}, {150, 120}, {171, 117}), b = Carry({}, {150, 120}, {171, 117});
  ASSERT_EQ(a.size(), 1U);
  EXPECT_EQ(cv::countNonZero(a[0].mask != b[0].mask), 0);
}

TEST(MaskPropagation, MaskOverTheWholeImageIsCarriedWithoutHarm) {
  const CarryScene scene;
  Instance all = scene.MakeInstance({150, 120});
  all.mask = cv::Mat(scene.size, CV_8UC1, cv::Scalar(255));
  EXPECT_LE(Carry(scene, all, {150, 120}, {160, 120}).size(), 1U);
}

TEST(MaskPropagation, OddSizesWork) {
  const CarryScene scene{.size = {321, 241}};
  const auto carried = Carry(scene, {150, 120}, {160, 120});
  ASSERT_EQ(carried.size(), 1U);
  EXPECT_GT(Iou(carried[0].mask, scene.Mask({160, 120})), 0.93);
}

TEST(MaskPropagation, ImagesOfAnotherSizeAreAProgrammersError) {
  const CarryScene scene, other{.size = {160, 120}};
  const MaskPropagation propagation({scene.camera(), 4}, {});
  const cv::Mat cell_depth_m(60, 80, CV_32FC1, cv::Scalar(1));
  EXPECT_THROW(propagation.Prepare({other.MakeInstance({80, 60})}, cell_depth_m), std::logic_error);
  const cv::Mat origins = OwnOrigins({40, 30}), depth_m(30, 40, CV_32FC1, cv::Scalar(1));
  EXPECT_THROW(propagation.Prepare({}, depth_m), std::logic_error);
  EXPECT_THROW(propagation.Carry({}, {origins, depth_m, depth_m}), std::logic_error);
}

}  // namespace
}  // namespace ofm
