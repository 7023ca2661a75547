#include "ofm/sim/tum_writer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "ofm/base/error.h"
#include "ofm/base/time.h"
#include "ofm/io/camera_file.h"
#include "ofm/io/read_file.h"
#include "ofm/io/test_folder.h"
#include "ofm/io/trajectory_file.h"
#include "ofm/io/tum_sequence.h"
#include "ofm/sim/scene_flow.h"

namespace ofm {
namespace {

namespace fs = std::filesystem;

class TumWriter : public testing::Test {
 protected:
  TumWriter() {
    options_.frames = 3;
    options_.camera = MakeSimCamera(160, 120);
    options_.camera.k1 = 0.1;
    options_.room.people = 1;
  }

  /// Lines that are not comments, split at blanks.
  std::vector<std::vector<std::string>> Rows(const std::string& name) const {
    std::vector<std::vector<std::string>> rows;
    std::ifstream file(folder_.path() / name);
    for (std::string line; std::getline(file, line);) {
      if (line.empty() || line[0] == '#') continue;
      std::istringstream words(line);
      rows.emplace_back(std::istream_iterator<std::string>(words),
                        std::istream_iterator<std::string>());
    }
    return rows;
  }

  SimSequenceOptions options_;
  TestFolder folder_;
};

TEST_F(TumWriter, ListsNameEveryFrameWithItsStamp) {
  const SimSequence sequence(options_);
  WriteTumSequence(sequence, folder_.path());
  const auto rgb = Rows("rgb.txt"), depth = Rows("depth.txt"), both = Rows("associations.txt");
  ASSERT_EQ(rgb.size(), 3U);
  ASSERT_EQ(depth.size(), 3U);
  ASSERT_EQ(both.size(), 3U);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(ParseSeconds(rgb[i][0]), sequence.StampNs(FrameId(i)));
    EXPECT_TRUE(fs::exists(folder_.path() / rgb[i][1]));
    EXPECT_TRUE(fs::exists(folder_.path() / depth[i][1]));
    EXPECT_EQ(both[i], (std::vector<std::string>{rgb[i][0], rgb[i][1], depth[i][0], depth[i][1]}));
  }
}

TEST_F(TumWriter, ImagesAreThoseOfTheSequence) {
  const SimSequence sequence(options_);
  WriteTumSequence(sequence, folder_.path());
  const RgbdFrame frame = sequence.Frame(FrameId(1));
  const std::string file = frame.name + ".png";
  const cv::Mat color = cv::imread(folder_.path() / "rgb" / file, cv::IMREAD_UNCHANGED);
  EXPECT_EQ(cv::norm(color, frame.color, cv::NORM_INF), 0);
  cv::Mat depth = cv::imread(folder_.path() / "depth" / file, cv::IMREAD_UNCHANGED);
  ASSERT_EQ(depth.type(), CV_16UC1);
  depth.convertTo(depth, CV_32F, 1 / options_.camera.depth_scale);
  EXPECT_LE(cv::norm(depth, frame.depth_m, cv::NORM_INF), 0.502 / options_.camera.depth_scale);
  const cv::Mat mask = cv::imread(folder_.path() / "mask" / file, cv::IMREAD_UNCHANGED);
  ASSERT_EQ(mask.type(), CV_8UC1);
  EXPECT_EQ(cv::norm(mask, sequence.MoverMask(FrameId(1)), cv::NORM_INF), 0);
  EXPECT_GT(cv::countNonZero(mask), 0);
}

TEST_F(TumWriter, ReaderGivesTheSequenceBack) {
  const SimSequence sequence(options_);
  WriteTumSequence(sequence, folder_.path());
  const RgbdSequence read(folder_.path(), ResolveCamera("auto", folder_.path()));
  EXPECT_EQ(read.camera().fx, options_.camera.fx);
  EXPECT_EQ(read.camera().k1, options_.camera.k1);
  EXPECT_EQ(read.camera().baseline_m, options_.camera.baseline_m);
  ASSERT_EQ(read.size(), 3U);
  for (std::uint32_t i = 0; i < 3; ++i) {
    const RgbdFrame frame = read.Load(i);
    const RgbdFrame expected = sequence.Frame(FrameId(i));
    EXPECT_EQ(frame.stamp_ns, expected.stamp_ns);
    EXPECT_EQ(frame.name, expected.name);
    EXPECT_EQ(cv::norm(frame.color, expected.color, cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(frame.gray, expected.gray, cv::NORM_INF), 0);
    EXPECT_LE(cv::norm(frame.depth_m, expected.depth_m, cv::NORM_INF), 1.01e-4);
  }
  ASSERT_TRUE(read.groundtruth());
  const Trajectory truth = LoadTrajectory(*read.groundtruth());
  ASSERT_EQ(truth.size(), 3U);
  for (std::uint32_t i = 0; i < 3; ++i) {
    const RigidTransform error =
        truth[i].world_from_camera.Inverse() * sequence.WorldFromCamera(FrameId(i));
    EXPECT_EQ(truth[i].stamp_ns, sequence.StampNs(FrameId(i)));
    EXPECT_LT(error.translation().norm(), 1e-8);
    EXPECT_LT(error.RotationAngle(), 1e-7);
  }
}

TEST_F(TumWriter, CameraAndActorsAreDescribed) {
  WriteTumSequence(SimSequence(options_), folder_.path());
  const auto camera = nlohmann::json::parse(std::ifstream(folder_.path() / "camera.json"));
  EXPECT_EQ(camera["width"], 160);
  EXPECT_EQ(camera["height"], 120);
  EXPECT_EQ(camera["fx"], options_.camera.fx);
  EXPECT_EQ(camera["cy"], options_.camera.cy);
  EXPECT_EQ(camera["distortion"], nlohmann::json({0.1, 0.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(camera["depth_scale"], 5000);
  const auto actors = nlohmann::json::parse(std::ifstream(folder_.path() / "actors.json"));
  ASSERT_EQ(actors["actors"].size(), 1U);
  EXPECT_EQ(actors["actors"][0]["kind"], "person");
  EXPECT_EQ(actors["actors"][0]["id"], 1);
}

TEST_F(TumWriter, ThreadsChangeNoByteAndGiveEachFrameOnce) {
  const SimSequence sequence(options_);
  const fs::path one = folder_.path() / "one", two = folder_.path() / "two";
  WriteTumSequence(sequence, one);
  std::atomic<int> frames = 0;
  double share = 0;
  TumWriterOptions options;
  options.threads = 2;
  options.on_frame = [&](const SimFrame& rendered) {
    EXPECT_EQ(rendered.instance.size(), rendered.frame.color.size());
    ++frames;
  };
  options.on_share = [&](double done) { share = done; };
  WriteTumSequence(sequence, two, options);
  EXPECT_EQ(frames, 3);
  EXPECT_EQ(share, 1);
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(one)) {
    if (!entry.is_regular_file()) continue;
    EXPECT_EQ(ReadFile(entry.path()), ReadFile(two / fs::relative(entry.path(), one)));
    ++files;
  }
  EXPECT_EQ(files, 9 + 6);
}

TEST_F(TumWriter, FlowIsThatOfTheSequenceAndTheLastFrameHasNone) {
  const SimSequence sequence(options_);
  TumWriterOptions options;
  options.flow = FlowFiles::kWrite;
  WriteTumSequence(sequence, folder_.path(), options);
  const std::string file = sequence.Frame(FrameId(1)).name + ".png";
  const cv::Mat encoded =
      cv::imread((folder_.path() / "flow" / file).string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(encoded.type(), CV_16UC3);
  const cv::Mat difference = DecodeFlow(encoded) - sequence.FlowToNext(FrameId(1));
  EXPECT_LE(cv::norm(difference, cv::NORM_INF), 1.01 / 64);
  const auto files = fs::directory_iterator(folder_.path() / "flow");
  EXPECT_EQ(std::distance(fs::begin(files), fs::end(files)), 2);
}

TEST_F(TumWriter, WhatAFunctionThrowsEndsTheWriting) {
  TumWriterOptions options;
  options.threads = 2;
  options.on_frame = [](const SimFrame&) { throw Error("no more"); };
  const std::string message =
      ErrorOf([&] { WriteTumSequence(SimSequence(options_), folder_.path(), options); });
  EXPECT_EQ(message, "no more");
  EXPECT_FALSE(fs::exists(folder_.path() / "rgb.txt"));
}

TEST_F(TumWriter, FolderThatCannotBeMadeIsNamed) {
  const fs::path file = folder_.Write("sequence", "a file");
  const std::string message =
      ErrorOf([&] { WriteTumSequence(SimSequence(options_), file / "below"); });
  EXPECT_NE(message.find(file.string()), std::string::npos) << message;
}

TEST_F(TumWriter, FileThatCannotBeWrittenIsNamed) {
  const fs::path blocked = folder_.path() / "groundtruth.txt";
  fs::create_directories(blocked / "below");
  const std::string message =
      ErrorOf([&] { WriteTumSequence(SimSequence(options_), folder_.path()); });
  EXPECT_NE(message.find(blocked.string()), std::string::npos) << message;
}

TEST_F(TumWriter, ImageThatCannotBeWrittenIsNamed) {
  const SimSequence sequence(options_);
  const fs::path blocked = folder_.path() / "rgb" / (sequence.Frame(FrameId(0)).name + ".png");
  fs::create_directories(blocked);
  const std::string message = ErrorOf([&] { WriteTumSequence(sequence, folder_.path()); });
  EXPECT_NE(message.find(blocked.string()), std::string::npos) << message;
  EXPECT_FALSE(fs::exists(folder_.path() / "rgb.txt"));
}

}  // namespace
}  // namespace ofm
