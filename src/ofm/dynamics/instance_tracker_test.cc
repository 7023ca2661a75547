#include "ofm/dynamics/instance_tracker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace ofm {
namespace {

const cv::Size kSize(640, 480);
constexpr std::int64_t kInterval_ns = 33'000'000;

/// A person of 60 × 200 px.
struct Person {
  cv::Rect box;
  float depth_m = 1.5F;
  ClassId class_id = ClassId(0);
};

/// What the network sees of people in front of a wall at 4 m.
struct View {
  std::vector<Instance> instances;
  cv::Mat depth_m = cv::Mat(kSize, CV_32FC1, cv::Scalar(4));

  /// Those after `seen` are there, but the network misses them.
  explicit View(const std::vector<Person>& people, std::size_t seen = 100) {
    for (std::size_t i = 0; i < people.size(); ++i) {
      const cv::Rect inside = people[i].box & cv::Rect({}, kSize);
      depth_m(inside).setTo(people[i].depth_m);
      if (i >= seen) continue;
      cv::Mat mask = cv::Mat::zeros(kSize, CV_8UC1);
      mask(inside).setTo(255);
      instances.push_back(
          {InstanceId(static_cast<std::uint32_t>(i)), people[i].class_id, 0.9F, inside, mask});
    }
  }
};

InstanceTracks Track(const InstanceTracks& before, const View& view,
                     const InstanceTrackerOptions& options = {}) {
  return TrackInstances(before, {view.instances, view.depth_m, before.stamp_ns + kInterval_ns},
                        options);
}

/// A person that goes 8 px a frame to the right.
Person Walker(int frame) { return {cv::Rect(100 + 8 * frame, 120, 60, 200)}; }

InstanceTracks FollowWalker(int frames) {
  InstanceTracks tracks;
  for (int i = 0; i < frames; ++i) tracks = Track(tracks, View({Walker(i)}));
  return tracks;
}

double Iou(const cv::Mat& mask, const cv::Rect& box) {
  cv::Mat truth = cv::Mat::zeros(mask.size(), CV_8UC1);
  truth(box).setTo(255);
  return cv::countNonZero(mask & truth) / static_cast<double>(cv::countNonZero(mask | truth));
}

TEST(InstanceTracker, DoubtfulDetectionContinuesATrackButBeginsNone) {
  View doubtful({Walker(1)});
  doubtful.instances[0].score = 0.3F;
  EXPECT_TRUE(Track({}, doubtful).tracks.empty());
  const InstanceTracks known = Track({}, View({Walker(0)}));
  const InstanceTracks after = Track(known, doubtful);
  ASSERT_EQ(after.tracks.size(), 1U);
  EXPECT_EQ(after.tracks[0].hits, 2);
  InstanceTrackerOptions trusting;
  trusting.birth_score = 0.3;
  EXPECT_EQ(Track({}, doubtful, trusting).tracks.size(), 1U);
}

TEST(InstanceTracker, AWalkerKeepsHisIdAndHisMask) {
  InstanceTracks tracks;
  for (int i = 0; i < 10; ++i) {
    const View view({Walker(i)});
    tracks = Track(tracks, view);
    ASSERT_EQ(tracks.tracks.size(), 1U);
    EXPECT_EQ(tracks.tracks[0].instance.id, InstanceId(0));
    EXPECT_EQ(tracks.tracks[0].missed_s, 0);
    EXPECT_EQ(cv::countNonZero(tracks.tracks[0].instance.mask != view.instances[0].mask), 0);
  }
  EXPECT_EQ(tracks.tracks[0].hits, 10);
  EXPECT_NEAR(tracks.tracks[0].state.mean(5), 8 / 0.033, 30);
}

TEST(InstanceTracker, MissedDetectionsAreBridgedAtThePredictedPlace) {
  InstanceTracks tracks = FollowWalker(12);
  for (int i = 12; i < 20; ++i) {
    tracks = Track(tracks, View({Walker(i)}, 0));
    ASSERT_EQ(tracks.tracks.size(), 1U) << i;
    EXPECT_GT(Iou(tracks.tracks[0].instance.mask, Walker(i).box), 0.8) << i;
    EXPECT_EQ(tracks.tracks[0].instance.box, cv::boundingRect(tracks.tracks[0].instance.mask));
    EXPECT_GT(tracks.tracks[0].missed_s, 0);
    EXPECT_LT(tracks.tracks[0].instance.score, 0.9F);
  }
  tracks = Track(tracks, View({Walker(20)}));
  ASSERT_EQ(tracks.tracks.size(), 1U);
  EXPECT_EQ(tracks.tracks[0].instance.id, InstanceId(0)) << "found again";
  EXPECT_EQ(tracks.tracks[0].missed_s, 0);
}

TEST(InstanceTracker, ATrackMissedForTooLongEnds) {
  InstanceTracks tracks = FollowWalker(5);
  int bridged = 0;
  for (; !tracks.tracks.empty(); ++bridged) {
    ASSERT_LT(bridged, 100);
    tracks = Track(tracks, View({Walker(5 + bridged)}, 0));
  }
  EXPECT_EQ(bridged - 1, static_cast<int>(0.4 / 0.033));
  tracks = Track(tracks, View({Walker(5)}));
  EXPECT_EQ(tracks.tracks.at(0).instance.id, InstanceId(1)) << "ids are not used twice";
}

TEST(InstanceTracker, OneDetectionAloneIsNotBridged) {
  EXPECT_TRUE(Track(FollowWalker(1), View({}, 0)).tracks.empty());
}

TEST(InstanceTracker, BridgedMaskLeavesOutWhatLiesBehind) {
  const InstanceTracks tracks = FollowWalker(12);
  Person turned = Walker(12);
  turned.box.width /= 2;  // half of him is gone: there is the wall
  const InstanceTracks bridged = Track(tracks, View({turned}, 0));
  ASSERT_EQ(bridged.tracks.size(), 1U);
  EXPECT_GT(Iou(bridged.tracks[0].instance.mask, turned.box), 0.85);
}

TEST(InstanceTracker, PeopleWhoCrossKeepTheirIdsByDepth) {
  const auto people = [](int i) {
    return std::vector<Person>{{cv::Rect(100 + 12 * i, 120, 60, 200), 1.2F},
                               {cv::Rect(400 - 12 * i, 120, 60, 200), 2.8F}};
  };
  InstanceTracks tracks;
  for (int i = 0; i < 25; ++i) {
    View view(people(i));
    if (i % 2 == 1) std::swap(view.instances[0], view.instances[1]);
    tracks = Track(tracks, view);
    ASSERT_EQ(tracks.tracks.size(), 2U) << i;
  }
  const bool first_is_near = tracks.tracks[0].state.mean(5) > 0;
  EXPECT_TRUE(first_is_near);
  EXPECT_NEAR(tracks.tracks[0].instance.box.x, 100 + 12 * 24, 2);
  EXPECT_NEAR(tracks.tracks[1].instance.box.x, 400 - 12 * 24, 2);
}

TEST(InstanceTracker, ClassesAreNotMixed) {
  const InstanceTracks tracks = FollowWalker(3);
  Person chair = Walker(3);
  chair.class_id = ClassId(56);
  const InstanceTracks after = Track(tracks, View({chair}));
  ASSERT_EQ(after.tracks.size(), 2U);
  EXPECT_EQ(after.tracks[1].instance.class_id, ClassId(56));
  EXPECT_EQ(after.tracks[1].instance.id, InstanceId(1));
}

TEST(InstanceTracker, WhoLeavesTheImageIsNotBridged) {
  InstanceTracks tracks;
  for (int i = 0; i < 7; ++i) {
    tracks = Track(tracks, View({{cv::Rect(500 + 20 * i, 120, 60, 200)}}));
  }
  EXPECT_FALSE(tracks.tracks.empty());
  for (int i = 0; i < 4; ++i) tracks = Track(tracks, View({}, 0));
  EXPECT_TRUE(tracks.tracks.empty());
}

TEST(InstanceTracker, WithoutAnyDepthTracksAndBridges) {
  InstanceTracks tracks;
  for (int i = 0; i < 10; ++i) {
    View view({Walker(i)}, i < 9 ? 1 : 0);
    view.depth_m.setTo(0);
    tracks = Track(tracks, view);
    ASSERT_EQ(tracks.tracks.size(), 1U);
  }
  EXPECT_GT(Iou(tracks.tracks[0].instance.mask, Walker(9).box), 0.8);
}

TEST(InstanceTracker, TheTracksGivenAreNotTouched) {
  const InstanceTracks before = FollowWalker(6);
  const cv::Mat mask = before.tracks[0].instance.mask.clone();
  Track(before, View({Walker(6)}, 0));
  EXPECT_EQ(cv::countNonZero(before.tracks[0].instance.mask != mask), 0);
  EXPECT_EQ(before.tracks[0].missed_s, 0);
}

TEST(InstanceTracker, GoingBackInTimeIsAProgrammersError) {
  const InstanceTracks before = FollowWalker(2);
  const View view({Walker(2)});
  EXPECT_THROW(TrackInstances(before, {view.instances, view.depth_m, 0}, {}), std::logic_error);
}

}  // namespace
}  // namespace ofm
