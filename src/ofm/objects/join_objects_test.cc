#include "ofm/objects/join_objects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/objects/test_room.h"

namespace ofm {
namespace {

using test::At;
using test::Box;
using test::kBook;
using test::kChair;
using test::kLaptop;
using test::LookFrom;
using test::ObjectsOf;
using test::Walk;
using test::Wall;

/// Something of 0.5 x 0.6 x 0.28 m, 2 m ahead, whose left side is at `left`.
Box Thing(double left, std::uint8_t class_id) {
  return {{left, -.3, 2.02}, {left + .5, .3, 2.3}, test::kRed, class_id, false};
}

TEST(JoinObjects, TellsWhatAnObjectIsAndWhereItStands) {
  const auto poses = Walk(8, -.5, .15);
  const std::vector<SceneObject> objects =
      ObjectsOf(LookFrom(poses, {Wall(), Thing(0, kChair)}), poses);
  ASSERT_EQ(objects.size(), 1U);
  const SceneObject& chair = objects[0];
  EXPECT_EQ(chair.id, ObjectId(0));
  EXPECT_THAT(chair.classes, testing::ElementsAre(ClassProbability{ClassId(kChair), 1}));
  EXPECT_LT((chair.centroid_in_world - Eigen::Vector3d(.25, 0, 2.05)).norm(), .05);
  EXPECT_NEAR(chair.box.size_m.x(), .5, .06);
  // The masks' rims, which are left out, are 5 cm wide at this resolution.
  EXPECT_NEAR(chair.box.size_m.z(), .6, .11) << "along up";
  EXPECT_EQ(chair.views, 8);
  EXPECT_EQ(chair.views_expected, 8);
  EXPECT_NEAR(chair.confidence, .9, 1e-6);
  EXPECT_EQ(chair.first_seen_ns, 0);
  EXPECT_EQ(chair.last_seen_ns, 7'000'000'000);
  EXPECT_EQ(chair.color, test::kRed);
  EXPECT_GT(chair.point_count, 500);
  ASSERT_EQ(chair.sightings.size(), 8U);
  EXPECT_EQ(chair.sightings[3].keyframe, KeyframeId(3));
  EXPECT_EQ(chair.sightings[3].instance, 0U);
}

TEST(JoinObjects, NeighboursOfOneClassStayTwoAndPartialViewsAreOne) {
  // The camera comes in from the left, and at first sees parts.
  const auto poses = Walk(16, -1.6, .2);
  const auto frames = LookFrom(poses, {Wall(), Thing(-.55, kChair), Thing(0, kChair)});
  const std::vector<SceneObject> objects = ObjectsOf(frames, poses);
  ASSERT_EQ(objects.size(), 2U);
  for (const SceneObject& object : objects) EXPECT_NEAR(object.box.size_m.x(), .5, .08);
  EXPECT_NEAR((objects[0].centroid_in_world - objects[1].centroid_in_world).norm(), .55, .05);
}

TEST(JoinObjects, AWrongClassInAMinorityIsAProbabilityAndNoSecondObject) {
  const auto poses = Walk(8, -.5, .15);
  auto frames = LookFrom(poses, {Wall(), Thing(0, kBook)});
  for (const std::uint32_t id : {0U, 5U}) {
    frames[KeyframeId(id)].instances[0].class_id = ClassId(kLaptop);
  }
  const std::vector<SceneObject> objects = ObjectsOf(frames, poses);
  ASSERT_EQ(objects.size(), 1U);
  ASSERT_EQ(objects[0].classes.size(), 2U);
  EXPECT_EQ(objects[0].class_id(), ClassId(kBook));
  EXPECT_NEAR(objects[0].classes[0].probability, .75, 1e-6);
  EXPECT_NEAR(objects[0].classes[1].probability, .25, 1e-6);
}

TEST(JoinObjects, HalvesJoinWhenThePosesAreCorrected) {
  // The camera comes back with a drift of 0.7 m: the same thing is there twice.
  const auto truth = Walk(8, -.5, .15);
  const auto frames = LookFrom(truth, {Wall(), Thing(0, kChair)});
  auto drifted = truth;
  for (std::uint32_t id = 4; id < 8; ++id) {
    drifted[KeyframeId(id)] = At(.7, 0, 0) * truth.at(KeyframeId(id));
  }
  EXPECT_EQ(ObjectsOf(frames, drifted).size(), 2U);
  const std::vector<SceneObject> corrected = ObjectsOf(frames, truth);
  ASSERT_EQ(corrected.size(), 1U);
  EXPECT_EQ(corrected[0].views, 8);
}

TEST(JoinObjects, WhatMostViewsContradictGoes) {
  const auto poses = Walk(20, -.5, .05);
  auto frames = LookFrom(poses, {Wall(), Thing(0, kChair), Thing(-.6, kBook)});
  for (auto& [id, frame] : frames) {
    if (id.value < 18) frame.instances.pop_back();  // two of 20 saw a book
  }
  const std::vector<SceneObject> objects = ObjectsOf(frames, poses);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].class_id(), ClassId(kChair));
  ObjectOptions believing;
  believing.join.min_confidence = 0;
  const std::vector<SceneObject> all = ObjectsOf(frames, poses, believing);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[1].views, 2);
  EXPECT_GE(all[1].views_expected, 18);
  EXPECT_NEAR(all[1].confidence, 2 * .9 / all[1].views_expected, 1e-6);
}

TEST(JoinObjects, AViewThatSomethingHidesContradictsNothing) {
  const auto poses = Walk(20, -.1, .01);
  const Box screen{{-.5, -.6, 1}, {1, .6, 1.1}, test::kGrey, kNoLabel, false};
  auto frames = LookFrom(poses, {Wall(), Thing(0, kChair)});
  const auto hidden = LookFrom(poses, {Wall(), Thing(0, kChair), screen});
  for (std::uint32_t id = 2; id < 20; ++id) frames[KeyframeId(id)] = hidden.at(KeyframeId(id));
  const std::vector<SceneObject> objects = ObjectsOf(frames, poses);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].views, 2);
  EXPECT_EQ(objects[0].views_expected, 2);
}

TEST(JoinObjects, NeedsTwoViewsWithUsablePoses) {
  auto poses = Walk(3, -.2, .2);
  const auto frames = LookFrom(poses, {Wall(), Thing(0, kChair)});
  poses.erase(KeyframeId(0));
  EXPECT_EQ(ObjectsOf(frames, poses).size(), 1U);
  poses[KeyframeId(1)] = At(std::nan(""), 0, 0);
  EXPECT_TRUE(ObjectsOf(frames, poses).empty());
  EXPECT_TRUE(ObjectsOf({}, {}).empty());
}

}  // namespace
}  // namespace ofm
