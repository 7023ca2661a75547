#include "ofm/view/live_messages.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "ofm/map/test_map.h"

namespace ofm {
namespace {

using nlohmann::json;

TEST(LiveMessages, AStateTellsWhatIsKnown) {
  LiveState state;
  state.frames_done = 7;
  state.status = TrackingStatus::kTracked;
  state.world_from_camera = RigidTransform(Eigen::Quaterniond::Identity(), {1, 2, 3});
  const json message = json::parse(EncodeState(state));
  EXPECT_EQ(message["kind"], "state");
  EXPECT_EQ(message["frames_done"], 7);
  EXPECT_EQ(message["status"], "tracked");
  EXPECT_EQ(message["has_pose"], true);
  EXPECT_FALSE(message.contains("frames"));
  EXPECT_EQ(message["world_from_camera"],
            (std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1}));
}

TEST(LiveMessages, ALostCameraHasNoPose) {
  LiveState state;
  state.status = TrackingStatus::kLost;
  state.frames = 9;
  const json message = json::parse(EncodeState(state));
  EXPECT_EQ(message["has_pose"], false);
  EXPECT_EQ(message["frames"], 9);
  EXPECT_FALSE(message.contains("world_from_camera"));
}

TEST(LiveMessages, EveryStatusHasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (const TrackingStatus status :
       {TrackingStatus::kWaiting, TrackingStatus::kInitialized, TrackingStatus::kTracked,
        TrackingStatus::kRelocalized, TrackingStatus::kReckoned, TrackingStatus::kLost}) {
    names.insert(NameOf(status));
  }
  EXPECT_EQ(names.size(), 6U);
}

TEST(LiveMessages, KeyframesAreThoseOfTheRunInTheNewestSubmap) {
  Map map(test::TestScales());
  for (std::uint32_t i = 0; i < 4; ++i) {
    Keyframe keyframe = test::MakePlainKeyframe(3, test::CameraAt(i, 0, 0));
    keyframe.frame_id = i == 0 ? FrameId() : FrameId(10 * i);
    keyframe.submap = i == 1 ? SubmapId(1) : SubmapId(0);
    map.AddKeyframe(std::move(keyframe));
  }
  const json message = json::parse(EncodeKeyframes(*map.Snapshot()));
  EXPECT_EQ(message["kind"], "keyframes");
  ASSERT_EQ(message["poses"].size(), 2U);
  EXPECT_EQ(message["poses"][0][0], 20);
  EXPECT_EQ(message["poses"][1][0], 30);
  EXPECT_EQ(message["poses"][1][1].size(), 16U);
  EXPECT_FLOAT_EQ(message["poses"][1][1][12].get<float>(),
                  static_cast<float>(test::CameraAt(3, 0, 0).Inverse().translation().x()));
}

TEST(LiveMessages, KeyframesOfNoMapAreNone) {
  EXPECT_TRUE(json::parse(EncodeKeyframes({}))["poses"].empty());
}

TEST(LiveMessages, NamesThatAreNoUtf8DoNotStopTheView) {
  EXPECT_EQ(json::parse(EncodeClasses({"person", "\xff"}))["names"].size(), 2U);
}

TEST(LiveMessages, ACloudIsInMillimetresWithoutWhatIsTooFar) {
  // As web/live/messages.test.js reads it.
  const std::vector<LabelledPoint> points = {{{1, -1, 2}, {10, 20, 30}, kNoLabel, 0},
                                             {{0, 0, 40}, {1, 1, 1}, 0, 0}};
  const std::string bytes = EncodeCloud(FrameId(263), points);
  const std::vector<int> expected = {'C', 0,   0, 0,  7,   1,   0, 0,  1,  0,  0,
                                     0,   232, 3, 24, 252, 208, 7, 10, 20, 30, 255};
  EXPECT_EQ(std::vector<int>(reinterpret_cast<const unsigned char*>(bytes.data()),
                             reinterpret_cast<const unsigned char*>(bytes.data()) + bytes.size()),
            expected);
}

TEST(LiveMessages, AnImageIsItsBytesAfterTheLetter) {
  const std::vector<unsigned char> jpeg = {0xff, 0xd8};
  EXPECT_EQ(EncodeImage(jpeg), std::string("I\0\0\0\xff\xd8", 6));
}

}  // namespace
}  // namespace ofm
