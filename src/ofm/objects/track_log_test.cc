#include "ofm/objects/track_log.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ofm/dense/test_scene.h"

namespace ofm {
namespace {

using test::At;
using test::SmallCamera;

constexpr std::int64_t kFrame_ns = 100'000'000;

/// Somebody 0.4 m wide whose middle is at (x, 0, 1.52) in the camera's frame.
struct View {
  explicit View(double x) {
    const LabelledFrame frame =
        test::Render(SmallCamera(), {test::Wall(), test::Person(x)}, {}, KeyframeId(0));
    depth_m = frame.depth_m;
    mask = frame.dynamic_mask;
  }
  FollowedInstance As(std::uint32_t id) const { return {InstanceId(id), ClassId(0), .7F, mask}; }
  cv::Mat depth_m, mask;
};

TEST(MedianPoint, IsTheMiddleOfTheSurfaceSeen) {
  View view(.1);
  const auto point = MedianPoint(view.mask, view.depth_m, SmallCamera());
  ASSERT_TRUE(point);
  EXPECT_LT((*point - Eigen::Vector3d(.1, 0, 1.52)).norm(), .05);
  view.depth_m.setTo(0);
  EXPECT_FALSE(MedianPoint(view.mask, view.depth_m, SmallCamera()));
  EXPECT_FALSE(MedianPoint(cv::Mat::zeros(view.mask.size(), CV_8UC1), view.depth_m, SmallCamera()));
}

TEST(TrackLog, FollowsSomebodyWhileTheCameraMovesToo) {
  TrackLog log(SmallCamera(), {});
  Trajectory trajectory;
  for (int i = 0; i <= 10; ++i) {
    const View view(-.3 + .06 * i);  // 0.6 m/s in the camera's frame
    log.Add(i * kFrame_ns, view.depth_m, {view.As(4)});
    trajectory.push_back({i * kFrame_ns, At(.04 * i, 0, 0)});  // and the camera 0.4 m/s
  }
  const std::vector<ObjectTrack> tracks = log.Build(trajectory);
  ASSERT_EQ(tracks.size(), 1U);
  EXPECT_EQ(tracks[0].id, InstanceId(4));
  EXPECT_EQ(tracks[0].class_id, ClassId(0));
  EXPECT_NEAR(tracks[0].score, .7, 1e-6);
  ASSERT_EQ(tracks[0].points.size(), 11U);
  for (int i = 0; i <= 10; ++i) {
    const TrackPoint& point = tracks[0].points[static_cast<std::size_t>(i)];
    EXPECT_EQ(point.stamp_ns, i * kFrame_ns);
    EXPECT_LT((point.position_in_world - Eigen::Vector3d(-.3 + .1 * i, 0, 1.52)).norm(), .05) << i;
    EXPECT_NEAR(point.speed_m_s, 1, .25) << i;
  }
}

TEST(TrackLog, KeepsPeopleApartAndLeavesOutWhatIsShortOrHasNoPose) {
  TrackLog log(SmallCamera(), {});
  const View left(-.4), right(.4);
  Trajectory trajectory;
  for (int i = 0; i < 8; ++i) {
    std::vector<FollowedInstance> seen{left.As(0), right.As(1)};
    if (i < 3) seen.push_back(right.As(2));
    log.Add(i * kFrame_ns, left.depth_m, seen);
    if (i != 4) trajectory.push_back({i * kFrame_ns, {}});
  }
  const std::vector<ObjectTrack> tracks = log.Build(trajectory);
  ASSERT_EQ(tracks.size(), 2U) << "the third was there for 0.2 s";
  EXPECT_EQ(tracks[0].points.size(), 7U);
  EXPECT_LT(tracks[0].points[0].position_in_world.x(), 0);
  EXPECT_GT(tracks[1].points[0].position_in_world.x(), 0);
  EXPECT_EQ(tracks[0].points[0].speed_m_s, 0);
  EXPECT_TRUE(log.Build({}).empty());
}

}  // namespace
}  // namespace ofm
