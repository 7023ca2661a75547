#include "ofm/io/tum_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "ofm/base/error.h"
#include "ofm/io/read_file.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

PinholeCamera SmallCamera() {
  PinholeCamera camera;
  camera.width = 32;
  camera.height = 24;
  camera.depth_scale = 1000;
  return camera;
}

/// A folder with three frames; frame i has colour (10 i, 20, 30) and depth (i + 1) m.
class RgbdSequenceTest : public testing::Test {
 protected:
  RgbdSequenceTest() {
    std::string rgb = "# color\n", depth;
    for (int i = 0; i < 3; ++i) {
      const std::string stamp = std::to_string(i) + ".5";
      rgb += stamp + " rgb/" + stamp + ".png\n";
      depth += std::to_string(i) + ".51 depth/" + stamp + ".png\n";
      WriteImage("rgb/" + stamp + ".png", cv::Mat(24, 32, CV_8UC3, cv::Scalar(10 * i, 20, 30)));
      WriteImage("depth/" + stamp + ".png", cv::Mat(24, 32, CV_16UC1, cv::Scalar(1000 * (i + 1))));
    }
    folder_.Write("rgb.txt", rgb);
    folder_.Write("depth.txt", depth);
  }

  void WriteImage(const std::string& name, const cv::Mat& image) const {
    std::filesystem::create_directories((folder_.path() / name).parent_path());
    cv::imwrite((folder_.path() / name).string(), image);
  }

  std::shared_ptr<const RgbdSequence> Open() const {
    return std::make_shared<RgbdSequence>(folder_.path(), SmallCamera());
  }

  std::string ErrorOfFrame(std::size_t index) const {
    return ErrorOf([&] { Open()->Load(index); });
  }

  TestFolder folder_;
};

TEST_F(RgbdSequenceTest, DepthIsOlderThanItsStampByTheCamerasDelay) {
  PinholeCamera camera = Open()->camera();
  camera.depth_delay_s = .015;
  const RgbdFrame frame = RgbdSequence(folder_.path(), camera).Load(2);
  EXPECT_EQ(frame.stamp_ns, 2'500'000'000);
  EXPECT_EQ(frame.depth_stamp_ns, 2'495'000'000);
}

TEST_F(RgbdSequenceTest, LoadsAFrame) {
  const auto sequence = Open();
  ASSERT_EQ(sequence->size(), 3u);
  EXPECT_EQ(sequence->entries().size(), 3u);
  const RgbdFrame frame = sequence->Load(2);
  EXPECT_EQ(frame.id, FrameId(2));
  EXPECT_EQ(frame.name, "2.5");
  EXPECT_EQ(frame.stamp_ns, 2'500'000'000);
  EXPECT_EQ(frame.depth_stamp_ns, 2'510'000'000);
  ASSERT_EQ(frame.color.type(), CV_8UC3);
  EXPECT_EQ(frame.color.at<cv::Vec3b>(5, 6), cv::Vec3b(20, 20, 30));
  ASSERT_EQ(frame.gray.type(), CV_8UC1);
  EXPECT_EQ(frame.gray.at<std::uint8_t>(5, 6), 23);  // .114 B + .587 G + .299 R
  ASSERT_EQ(frame.depth_m.type(), CV_32FC1);
  EXPECT_FLOAT_EQ(frame.depth_m.at<float>(5, 6), 3);
  EXPECT_EQ(frame.gray.size(), cv::Size(32, 24));
  EXPECT_FALSE(sequence->groundtruth());
}

TEST_F(RgbdSequenceTest, AnIndexPastTheEndIsAProgrammersError) {
  EXPECT_THROW(Open()->Load(3), std::logic_error);
}

TEST_F(RgbdSequenceTest, NamesTheListTheLineAndTheMissingImage) {
  std::filesystem::remove(folder_.path() / "rgb/1.5.png");
  const std::string where =
      (folder_.path() / "rgb.txt").string() + ":3: " + (folder_.path() / "rgb/1.5.png").string();
  EXPECT_EQ(ErrorOfFrame(1), where + ": does not exist; check the path");
  EXPECT_EQ(ErrorOf([&] { TumFrameSource source(Open()); }),
            where + ": does not exist; copy it or remove the line");
  EXPECT_EQ(ErrorOfFrame(0), "");
}

TEST_F(RgbdSequenceTest, NamesATruncatedImage) {
  const auto path = folder_.path() / "depth/1.5.png";
  const std::string bytes = ReadFile(path);
  folder_.Write("depth/1.5.png", bytes.substr(0, bytes.size() / 2));
  EXPECT_THAT(ErrorOfFrame(1), HasSubstr("depth.txt:2: " + path.string() + ": is truncated after"));
}

TEST_F(RgbdSequenceTest, NamesAnImageOfTheWrongSize) {
  WriteImage("rgb/0.5.png", cv::Mat(48, 64, CV_8UC3, cv::Scalar(0)));
  EXPECT_THAT(ErrorOfFrame(0), HasSubstr("rgb.txt:2: "));
  EXPECT_THAT(ErrorOfFrame(0),
              EndsWith("rgb/0.5.png: is 64x48, but the camera is 32x24; choose the right camera"));
  WriteImage("depth/2.5.png", cv::Mat(24, 31, CV_16UC1, cv::Scalar(0)));
  EXPECT_THAT(ErrorOfFrame(2), HasSubstr("depth.txt:3: "));
}

TEST_F(RgbdSequenceTest, NamesAnImageOfTheWrongKind) {
  WriteImage("depth/0.5.png", cv::Mat(24, 32, CV_8UC1, cv::Scalar(9)));
  EXPECT_THAT(ErrorOfFrame(0), HasSubstr("depth.txt:1: "));
  EXPECT_THAT(ErrorOfFrame(0), HasSubstr("depth image must have 1 channel of 16 bits"));
  WriteImage("rgb/1.5.png", cv::Mat(24, 32, CV_16UC1, cv::Scalar(9)));
  EXPECT_THAT(ErrorOfFrame(1), HasSubstr("colour image must have 3 channels of 8 bits"));
}

TEST_F(RgbdSequenceTest, PlaysAllFrames) {
  TumFrameSource source(Open());
  EXPECT_EQ(source.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    const auto frame = source.Next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->id, FrameId(i));
  }
  EXPECT_FALSE(source.Next());
  EXPECT_FALSE(source.Next());
}

TEST_F(RgbdSequenceTest, PlaysARange) {
  TumFrameSource source(Open(), {1, 1});
  EXPECT_EQ(source.size(), 1u);
  EXPECT_EQ(source.Next()->name, "1.5");
  EXPECT_FALSE(source.Next());
  EXPECT_EQ(TumFrameSource(Open(), {1, 0}).size(), 2u);
  EXPECT_EQ(TumFrameSource(Open(), {1, 99}).size(), 2u);
  EXPECT_THAT(ErrorOf([&] {
                TumFrameSource past(Open(), {3, 0});
              }),
              EndsWith("has 3 frames; none from number 3 on"));
}

TEST_F(RgbdSequenceTest, MissingFilesOutsideTheRangeDoNotMatter) {
  std::filesystem::remove(folder_.path() / "rgb/2.5.png");
  EXPECT_NO_THROW(TumFrameSource(Open(), {0, 2}));
}

TEST_F(RgbdSequenceTest, ABadFrameEndsTheSequence) {
  folder_.Write("rgb/1.5.png", "no picture");
  TumFrameSource source(Open());
  EXPECT_TRUE(source.Next());
  EXPECT_THROW(source.Next(), Error);
  EXPECT_FALSE(source.Next());
}

TEST(RgbdSequence, ReadsTheBenchmark) {
  const std::filesystem::path desk = OFM_SHARED_DIR "/data/tum_fr1_desk";
  if (!std::filesystem::exists(desk)) GTEST_SKIP() << "needs " << desk;
  const RgbdSequence sequence(desk, *FindCameraPreset("tum-fr1"));
  EXPECT_EQ(sequence.size(), 573u);
  EXPECT_EQ(sequence.groundtruth(), desk / "groundtruth.txt");
  const RgbdFrame frame = sequence.Load(572);
  EXPECT_EQ(frame.color.size(), cv::Size(640, 480));
  double max_m = 0;
  cv::minMaxLoc(frame.depth_m, nullptr, &max_m);
  EXPECT_GT(max_m, 0.5);
  EXPECT_LT(max_m, 13.2);
}

}  // namespace
}  // namespace ofm
