#include "ofm/view/live_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "ofm/pipeline/test_support.h"
#include "ofm/view/test_viewer.h"

namespace ofm {
namespace {

using nlohmann::json;
using test::PlaySource;
using test::Recording;
using test::Viewer;

constexpr int kFrames = 8;

/// As often as frames come.
LiveViewOptions Eager() {
  LiveViewOptions options;
  options.max_pictures_per_s = options.max_map_updates_per_s = 1e6;
  options.cloud_resolution_m = 0.1;
  return options;
}

std::uint16_t PortOf(const LiveView& view) {
  const std::string url = view.url();
  return static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
}

/// What a viewer saw until the end.
struct Seen {
  std::vector<std::string> pictures, clouds;
  std::map<std::string, json> texts;  // the last of each kind
};

Seen WatchToTheEnd(Viewer& viewer) {
  Seen seen;
  while (const auto message = viewer.Read()) {
    if (viewer.got_text()) {
      const json text = json::parse(*message);
      seen.texts[text["kind"]] = text;
    } else {
      (message->front() == 'I' ? seen.pictures : seen.clouds).push_back(*message);
    }
  }
  return seen;
}

TEST(LiveView, AViewerSeesTheRunToItsEnd) {
  const Recording recording(kFrames);
  auto view = std::make_unique<LiveView>(Eager(), recording.sequence.camera(),
                                         std::vector<std::string>{"person"}, kFrames);
  Viewer viewer(PortOf(*view));
  Seen seen;
  std::jthread watching([&] { seen = WatchToTheEnd(viewer); });
  PlaySource source(recording.images);
  const auto slam = test::MakeSlam(recording, test::KeyframesOften());
  RunContext context;
  context.observers.push_back(view.get());
  const RunOutcome outcome = RunSequential(*slam, source, context);
  view->ShowMap(outcome.map);
  view.reset();
  watching.join();

  EXPECT_EQ(seen.texts["classes"]["names"], json({"person"}));
  EXPECT_EQ(seen.texts["state"]["frames_done"], kFrames);
  EXPECT_EQ(seen.texts["state"]["frames"], kFrames);
  EXPECT_TRUE(seen.texts["state"].contains("world_from_camera"));
  EXPECT_EQ(seen.texts["keyframes"]["poses"].size(), outcome.map->keyframe_count);
  EXPECT_TRUE(seen.texts.contains("end"));
  EXPECT_EQ(seen.clouds.size(), outcome.counts.keyframes_made);
  ASSERT_FALSE(seen.pictures.empty());
  const std::string jpeg = seen.pictures.back().substr(4);
  const cv::Mat picture =
      cv::imdecode(std::vector<unsigned char>(jpeg.begin(), jpeg.end()), cv::IMREAD_COLOR);
  EXPECT_EQ(picture.size(), recording.images[0].color.size());
}

TEST(LiveView, TheRunIsTheSameWithIt) {
  const Recording recording(kFrames);
  const auto trajectory = [&](RunObserver* observer) {
    PlaySource source(recording.images);
    const auto slam = test::MakeSlam(recording, test::KeyframesOften());
    RunContext context;
    if (observer != nullptr) context.observers.push_back(observer);
    return RunSequential(*slam, source, context).trajectory;
  };
  LiveView view(Eager(), recording.sequence.camera(), {"person"}, kFrames);
  const Trajectory without = trajectory(nullptr), with = trajectory(&view);
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t i = 0; i < with.size(); ++i) {
    EXPECT_EQ(with[i].world_from_camera.translation(), without[i].world_from_camera.translation());
  }
}

TEST(LiveView, PicturesAreNoMoreThanAskedFor) {
  const Recording recording(3);
  LiveViewOptions options = Eager();
  options.max_pictures_per_s = 0.001;
  auto view = std::make_unique<LiveView>(options, recording.sequence.camera(),
                                         std::vector<std::string>{}, std::nullopt);
  Viewer viewer(PortOf(*view));
  Seen seen;
  std::jthread watching([&] { seen = WatchToTheEnd(viewer); });
  PlaySource source(recording.images);
  const auto slam = test::MakeSlam(recording);
  RunContext context;
  context.observers.push_back(view.get());
  RunSequential(*slam, source, context);
  view.reset();
  watching.join();
  EXPECT_EQ(seen.pictures.size(), 1U);
}

TEST(LivePicture, DrawsFeaturesOfThePoseInGreenAndOthersInBlue) {
  LivePicture picture;
  picture.prepared.frame.color = cv::Mat(40, 60, CV_8UC3, cv::Scalar::all(0));
  auto features = std::make_shared<FrameFeatures>();
  features->keypoints = {{{10, 10}, 0, 0, 0}, {{30, 20}, 0, 0, 0}};
  picture.prepared.features = features;
  picture.in_pose = {true, false};
  const cv::Mat image = DrawLivePicture(picture, {});
  EXPECT_EQ(image.at<cv::Vec3b>(10, 10), cv::Vec3b(0, 220, 0));
  EXPECT_EQ(image.at<cv::Vec3b>(20, 30), cv::Vec3b(255, 120, 0));
  EXPECT_EQ(cv::countNonZero(picture.prepared.frame.color.reshape(1)), 0);
}

}  // namespace
}  // namespace ofm
