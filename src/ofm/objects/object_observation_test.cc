#include "ofm/objects/object_observation.h"

#include <gtest/gtest.h>

#include "ofm/objects/test_room.h"

namespace ofm {
namespace {

using test::Chair;
using test::Look;
using test::Person;
using test::Policies;
using test::SmallCamera;
using test::Wall;

KeyframeObjects Observe(const InstanceFrame& frame, const ObjectObservationOptions& options = {},
                        const DynamicsOptions& dynamics = {}) {
  return ObjectObserver(SmallCamera(), options, Policies(dynamics)).Observe(frame);
}

InstanceFrame ChairAndPerson() {
  return Look(SmallCamera(), {Wall(), Chair(), Person(-.5)}, {}, KeyframeId(3));
}

TEST(ObjectObserver, KeepsTheInstancesSurfaceWithItsColour) {
  const KeyframeObjects seen = Observe(ChairAndPerson());
  EXPECT_EQ(seen.stamp_ns, 3'000'000'000);
  ASSERT_EQ(seen.observations.size(), 1U);
  const ObjectObservation& chair = seen.observations[0];
  EXPECT_EQ(chair.class_id, ClassId(test::kChair));
  EXPECT_EQ(chair.color, test::kRed);
  EXPECT_EQ(chair.instance, 0U);
  EXPECT_GT(chair.points_in_camera.size(), 300U) << "0.5 m x 0.6 m in steps of 2 cm";
  for (const Eigen::Vector3f& point : chair.points_in_camera) {
    EXPECT_TRUE(point.x() > .39F && point.x() < .91F && std::abs(point.z() - 2.02F) < .02F)
        << point.transpose();
  }
}

TEST(ObjectObserver, AMaskThatIsTooLargeBringsNoWallAlong) {
  InstanceFrame frame = ChairAndPerson();
  Instance& chair = frame.instances[0];
  cv::dilate(chair.mask, chair.mask, cv::Mat::ones(13, 13, CV_8UC1));
  chair.box = cv::boundingRect(chair.mask);
  const KeyframeObjects seen = Observe(frame);
  ASSERT_EQ(seen.observations.size(), 1U);
  for (const Eigen::Vector3f& point : seen.observations[0].points_in_camera) {
    EXPECT_LT(point.z(), 2.1F);
  }
}

TEST(ObjectObserver, LeavesOutWhatIsDoubtfulSmallOrFar) {
  InstanceFrame frame = ChairAndPerson();
  frame.instances[0].score = .2F;
  EXPECT_TRUE(Observe(frame).observations.empty());
  ObjectObservationOptions options;
  options.min_points = 2000;
  EXPECT_TRUE(Observe(ChairAndPerson(), options).observations.empty());
  options = {};
  options.range_m = 2;
  EXPECT_TRUE(Observe(ChairAndPerson(), options).observations.empty());
}

TEST(ObjectObserver, LeavesOutWhatMovesUnlessItsClassNeverDoes) {
  InstanceFrame frame = ChairAndPerson();
  frame.dynamic_mask = frame.instances[0].mask.clone();
  EXPECT_TRUE(Observe(frame).observations.empty());
  DynamicsOptions dynamics;
  dynamics.never_dynamic = {"chair"};
  EXPECT_EQ(Observe(frame, {}, dynamics).observations.size(), 1U);
  frame.dynamic_mask(cv::Rect(0, 0, 160, 75)).setTo(0);
  EXPECT_EQ(Observe(frame).observations.size(), 1U) << "a small part of it moves";
}

}  // namespace
}  // namespace ofm
