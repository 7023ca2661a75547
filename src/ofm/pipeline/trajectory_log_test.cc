#include "ofm/pipeline/trajectory_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ofm {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr SubmapId kFirst(0);

RigidTransform Shift(double x) {
  return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, 0, 0)};
}

/// A frame whose camera is at x, and at x - reference_x from its reference keyframe.
TrackingResult TrackedAt(double x, KeyframeId reference, double reference_x) {
  TrackingResult result;
  result.status = TrackingStatus::kTracked;
  result.camera_from_world = Shift(-x);
  result.reference = reference;
  result.camera_from_reference = Shift(reference_x - x);
  return result;
}

TrackingResult WithStatus(TrackingStatus status) {
  TrackingResult result;
  result.status = status;
  return result;
}

/// Where the cameras are along x.
std::vector<double> Places(const Trajectory& trajectory) {
  std::vector<double> places;
  for (const StampedPose& pose : trajectory) {
    places.push_back(pose.world_from_camera.translation().x());
  }
  return places;
}

/// A map with keyframes at the given places along x, ids from 0.
class TrajectoryLogTest : public testing::Test {
 protected:
  KeyframeId AddKeyframe(double x) { return AddKeyframe(x, ++stamp_ns_); }
  KeyframeId AddKeyframe(double x, std::int64_t stamp_ns) {
    Keyframe keyframe;
    keyframe.camera_from_world = Shift(-x);
    keyframe.stamp_ns = stamp_ns;
    keyframe.features = std::make_shared<FrameFeatures>();
    return map_.AddKeyframe(std::move(keyframe));
  }

  Map map_{OctaveScales(1, 1.2)};
  TrajectoryLog log_;
  std::int64_t stamp_ns_ = 0;
};

TEST_F(TrajectoryLogTest, KeepsFramesWithAPoseAndCountsAll) {
  log_.Add(FrameId(0), 10, WithStatus(TrackingStatus::kWaiting));
  log_.Add(FrameId(1), 11, TrackedAt(1, {}, 0));
  log_.Add(FrameId(2), 12, WithStatus(TrackingStatus::kLost));
  log_.Add(FrameId(4), 14, TrackedAt(4, {}, 0));
  EXPECT_EQ(log_.frames(), 4U);
  EXPECT_EQ(log_.CountWithPose(), 2U);
  const Trajectory live = log_.Live(kFirst);
  EXPECT_THAT(Places(live), ElementsAre(1, 4));
  EXPECT_EQ(live[0].stamp_ns, 11);
  EXPECT_EQ(live[1].stamp_ns, 14);
}

TEST_F(TrajectoryLogTest, FramesFollowTheirKeyframeWhenItIsMoved) {
  const KeyframeId keyframe = AddKeyframe(2);
  log_.Add(FrameId(0), 10, TrackedAt(3, keyframe, 2));
  EXPECT_THAT(Places(log_.Optimized(*map_.Snapshot(), kFirst)), ElementsAre(3));
  map_.SetKeyframePose(keyframe, Shift(-2.5));
  EXPECT_THAT(Places(log_.Optimized(*map_.Snapshot(), kFirst)), ElementsAre(3.5));
  EXPECT_THAT(Places(log_.Live(kFirst)), ElementsAre(3)) << "as known at the time";
}

TEST_F(TrajectoryLogTest, AFrameThatBecameAKeyframeHasItsPose) {
  const KeyframeId first = AddKeyframe(0), second = AddKeyframe(5);
  log_.Add(FrameId(0), 10, TrackedAt(5, first, 0));
  log_.SetKeyframe(FrameId(0), second);
  map_.SetKeyframePose(first, Shift(100));
  map_.SetKeyframePose(second, Shift(-6));
  EXPECT_THAT(Places(log_.Optimized(*map_.Snapshot(), kFirst)), ElementsAre(6));
}

TEST_F(TrajectoryLogTest, FramesOfARemovedKeyframeFollowItsAnchor) {
  const KeyframeId kept = AddKeyframe(0), removed = AddKeyframe(1);
  log_.Add(FrameId(0), 10, TrackedAt(1.5, removed, 1));
  map_.RemoveKeyframe(removed, kept);
  map_.SetKeyframePose(kept, Shift(-10));
  EXPECT_THAT(Places(log_.Optimized(*map_.Snapshot(), kFirst)), ElementsAre(11.5));
}

TEST_F(TrajectoryLogTest, WithoutAReferenceTheLivePoseStays) {
  log_.Add(FrameId(0), 10, TrackedAt(7, {}, 0));
  EXPECT_THAT(Places(log_.Optimized(*map_.Snapshot(), kFirst)), ElementsAre(7));
}

TEST_F(TrajectoryLogTest, IsEmptyAtFirst) {
  EXPECT_THAT(log_.Live(kFirst), IsEmpty());
  EXPECT_THAT(log_.Optimized(*map_.Snapshot(), kFirst), IsEmpty());
  EXPECT_EQ(log_.CountWithPose(), 0U);
}

TEST_F(TrajectoryLogTest, RefusesFramesOutOfOrderAndUnknownOnes) {
  log_.Add(FrameId(3), 10, TrackedAt(1, {}, 0));
  EXPECT_THROW(log_.Add(FrameId(3), 11, TrackedAt(1, {}, 0)), std::logic_error);
  EXPECT_THROW(log_.Add(FrameId(2), 11, TrackedAt(1, {}, 0)), std::logic_error);
  EXPECT_THROW(log_.SetKeyframe(FrameId(2), KeyframeId(0)), std::logic_error);
  EXPECT_THROW(log_.SetKeyframe(FrameId(9), KeyframeId(0)), std::logic_error);
}

/// A frame in each of two sub-maps, of which the second is joined to the first by a move of 10 m.
TEST_F(TrajectoryLogTest, TellsSubmapsApartUntilTheyAreJoined) {
  const KeyframeId first = AddKeyframe(0);
  Keyframe other = map_.GetKeyframe(first);
  other.submap = SubmapId();
  const KeyframeId second = map_.AddKeyframe(other);
  const SubmapId submap = map_.FindSubmap(second);
  TrackingResult begun = TrackedAt(0, {}, 0);
  begun.status = TrackingStatus::kInitialized;
  log_.Add(FrameId(0), 10, TrackedAt(1, first, 0));
  log_.Add(FrameId(1), 11, begun, {});
  log_.Add(FrameId(2), 12, TrackedAt(2, second, 0), submap);
  EXPECT_THAT(Places(log_.Optimized(*map_.Snapshot(), submap)), ElementsAre(2))
      << "where a frame is that never became a keyframe is not known";
  log_.SetKeyframe(FrameId(1), second);
  EXPECT_THAT(Places(log_.Optimized(*map_.Snapshot(), kFirst)), ElementsAre(1));
  EXPECT_THAT(Places(log_.Optimized(*map_.Snapshot(), submap)), ElementsAre(0, 2));
  EXPECT_EQ(KeyframeTrajectory(*map_.Snapshot(), submap).size(), 1U);
  map_.JoinSubmaps(submap, kFirst);
  map_.SetKeyframePose(second, Shift(-10));
  EXPECT_THAT(Places(log_.Optimized(*map_.Snapshot(), kFirst)), ElementsAre(1, 10, 12));
  EXPECT_THAT(Places(log_.Live(kFirst)), ElementsAre(1)) << "the rest was not known then";
  EXPECT_THAT(Places(log_.Live(submap)), ElementsAre(0, 2));
}

TEST_F(TrajectoryLogTest, KeyframeTrajectoryHasTheKeyframesThatAreLeft) {
  const KeyframeId first = AddKeyframe(1);
  const KeyframeId second = AddKeyframe(2);
  AddKeyframe(3);
  map_.RemoveKeyframe(second, first);
  const Trajectory trajectory = KeyframeTrajectory(*map_.Snapshot(), kFirst);
  EXPECT_THAT(Places(trajectory), ElementsAre(1, 3));
  EXPECT_EQ(trajectory[1].stamp_ns, 3);
}

TEST_F(TrajectoryLogTest, KeyframeTrajectoryIsByTimeAndHasEachTimeOnce) {
  for (const double place : {2, 3, 1}) AddKeyframe(place, static_cast<std::int64_t>(place));
  AddKeyframe(7, 3);
  EXPECT_THAT(Places(KeyframeTrajectory(*map_.Snapshot(), kFirst)), ElementsAre(1, 2, 3));
}

}  // namespace
}  // namespace ofm
