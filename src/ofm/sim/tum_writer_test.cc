#include "ofm/sim/tum_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "ofm/base/error.h"
#include "ofm/base/time.h"

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
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("ofm_tum_writer_" + std::to_string(::getpid()) + "_" + info->name());
    fs::remove_all(folder_);
  }
  ~TumWriter() override { fs::remove_all(folder_); }

  /// Lines that are not comments, split at blanks.
  std::vector<std::vector<std::string>> Rows(const std::string& name) const {
    std::vector<std::vector<std::string>> rows;
    std::ifstream file(folder_ / name);
    for (std::string line; std::getline(file, line);) {
      if (line.empty() || line[0] == '#') continue;
      std::istringstream words(line);
      rows.emplace_back(std::istream_iterator<std::string>(words),
                        std::istream_iterator<std::string>());
    }
    return rows;
  }

  SimSequenceOptions options_;
  fs::path folder_;
};

TEST_F(TumWriter, ListsNameEveryFrameWithItsStamp) {
  const SimSequence sequence(options_);
  WriteTumSequence(sequence, folder_);
  const auto rgb = Rows("rgb.txt"), depth = Rows("depth.txt"), both = Rows("associations.txt");
  ASSERT_EQ(rgb.size(), 3U);
  ASSERT_EQ(depth.size(), 3U);
  ASSERT_EQ(both.size(), 3U);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(ParseSeconds(rgb[i][0]), sequence.StampNs(FrameId(i)));
    EXPECT_TRUE(fs::exists(folder_ / rgb[i][1]));
    EXPECT_TRUE(fs::exists(folder_ / depth[i][1]));
    EXPECT_EQ(both[i], (std::vector<std::string>{rgb[i][0], rgb[i][1], depth[i][0], depth[i][1]}));
  }
}

TEST_F(TumWriter, ImagesAreThoseOfTheSequence) {
  const SimSequence sequence(options_);
  WriteTumSequence(sequence, folder_);
  const RgbdFrame frame = sequence.Frame(FrameId(1));
  const std::string file = frame.name + ".png";
  const cv::Mat color = cv::imread(folder_ / "rgb" / file, cv::IMREAD_UNCHANGED);
  EXPECT_EQ(cv::norm(color, frame.color, cv::NORM_INF), 0);
  cv::Mat depth = cv::imread(folder_ / "depth" / file, cv::IMREAD_UNCHANGED);
  ASSERT_EQ(depth.type(), CV_16UC1);
  depth.convertTo(depth, CV_32F, 1 / options_.camera.depth_scale);
  EXPECT_LE(cv::norm(depth, frame.depth_m, cv::NORM_INF), 0.502 / options_.camera.depth_scale);
  const cv::Mat mask = cv::imread(folder_ / "mask" / file, cv::IMREAD_UNCHANGED);
  ASSERT_EQ(mask.type(), CV_8UC1);
  EXPECT_EQ(cv::norm(mask, sequence.MoverMask(FrameId(1)), cv::NORM_INF), 0);
  EXPECT_GT(cv::countNonZero(mask), 0);
}

TEST_F(TumWriter, GroundTruthIsTheTruePoses) {
  const SimSequence sequence(options_);
  WriteTumSequence(sequence, folder_);
  const auto rows = Rows("groundtruth.txt");
  ASSERT_EQ(rows.size(), 3U);
  for (std::uint32_t i = 0; i < 3; ++i) {
    ASSERT_EQ(rows[i].size(), 8U);
    const auto number = [&](int k) { return std::stod(rows[i][k]); };
    const RigidTransform pose(Eigen::Quaterniond(number(7), number(4), number(5), number(6)),
                              Eigen::Vector3d(number(1), number(2), number(3)));
    const RigidTransform error = pose.Inverse() * sequence.WorldFromCamera(FrameId(i));
    EXPECT_LT(error.translation().norm(), 1e-8);
    EXPECT_LT(error.RotationAngle(), 1e-7);
  }
}

TEST_F(TumWriter, CameraAndActorsAreDescribed) {
  WriteTumSequence(SimSequence(options_), folder_);
  const auto camera = nlohmann::json::parse(std::ifstream(folder_ / "camera.json"));
  EXPECT_EQ(camera["width"], 160);
  EXPECT_EQ(camera["height"], 120);
  EXPECT_EQ(camera["fx"], options_.camera.fx);
  EXPECT_EQ(camera["cy"], options_.camera.cy);
  EXPECT_EQ(camera["distortion"], nlohmann::json({0.1, 0.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(camera["depth_scale"], 5000);
  const auto actors = nlohmann::json::parse(std::ifstream(folder_ / "actors.json"));
  ASSERT_EQ(actors["actors"].size(), 1U);
  EXPECT_EQ(actors["actors"][0]["kind"], "person");
  EXPECT_EQ(actors["actors"][0]["id"], 1);
}

TEST_F(TumWriter, FolderThatCannotBeMadeIsNamed) {
  std::ofstream(folder_) << "a file";
  try {
    WriteTumSequence(SimSequence(options_), folder_ / "sequence");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(folder_.string()), std::string::npos);
  }
}

TEST_F(TumWriter, FileThatCannotBeWrittenIsNamed) {
  fs::create_directories(folder_ / "groundtruth.txt");
  try {
    WriteTumSequence(SimSequence(options_), folder_);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.path(), folder_ / "groundtruth.txt");
  }
}

}  // namespace
}  // namespace ofm
