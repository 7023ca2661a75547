#include "ofm/pipeline/keyframe_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

/// A grey frame whose right half is dynamic.
PreparedFrame HalfMasked(std::int64_t stamp_ns) {
  PreparedFrame prepared;
  prepared.frame.stamp_ns = stamp_ns;
  prepared.frame.color = cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(100));
  prepared.dynamic.mask = cv::Mat::zeros(480, 640, CV_8UC1);
  prepared.dynamic.mask.colRange(320, 640).setTo(255);
  return prepared;
}

/// Shows `count` frames, one a second, of which every one or none is a key frame.
void Show(KeyframeImages& images, int count, const std::optional<KeyframeCandidate>& keyframe) {
  TrackingResult tracking;
  tracking.keyframe = keyframe;
  for (int i = 0; i < count; ++i) {
    const PreparedFrame prepared = HalfMasked(i * 1'000'000'000LL);
    images.OnFrame({prepared, tracking});
  }
}

std::vector<int> Seconds(const KeyframeImages& images) {
  std::vector<int> seconds;
  for (const KeyframeImage& image : images.images()) {
    seconds.push_back(static_cast<int>(image.stamp_ns / 1'000'000'000));
  }
  return seconds;
}

TEST(KeyframeImages, KeepsEveryKeyframeWhileThereAreFew) {
  KeyframeImages images(4);
  Show(images, 4, KeyframeCandidate());
  EXPECT_THAT(Seconds(images), testing::ElementsAre(0, 1, 2, 3));
}

TEST(KeyframeImages, IsSpreadEvenlyOverALongRun) {
  KeyframeImages images(4);
  Show(images, 40, KeyframeCandidate());
  EXPECT_THAT(Seconds(images), testing::ElementsAre(0, 16, 32));
}

TEST(KeyframeImages, TakesNoOtherFrames) {
  KeyframeImages images(4), none(0);
  Show(images, 5, {});
  Show(none, 5, KeyframeCandidate());
  EXPECT_TRUE(images.images().empty());
  EXPECT_TRUE(none.images().empty());
}

TEST(KeyframeImages, ShowsWhatIsDynamicInRed) {
  KeyframeImages images(1);
  Show(images, 1, KeyframeCandidate());
  const cv::Mat image = cv::imdecode(images.images().at(0).jpeg, cv::IMREAD_COLOR);
  ASSERT_EQ(image.size(), cv::Size(240, 180));
  const auto left = image.at<cv::Vec3b>(90, 30), right = image.at<cv::Vec3b>(90, 210);
  EXPECT_NEAR(left[0], left[2], 8);
  EXPECT_GT(right[2], right[0] + 60);
}

TEST(WriteKeyframeImages, ReplacesThoseOfAnEarlierRun) {
  const TestFolder folder;
  const auto keyframes = folder.path() / "keyframes";
  folder.Write("keyframes/1.000000.jpg", "old");
  WriteKeyframeImages(keyframes, {{2'500'000'000, {'n', 'e', 'w'}}});
  EXPECT_FALSE(std::filesystem::exists(keyframes / "1.000000.jpg"));
  EXPECT_TRUE(std::filesystem::exists(keyframes / "2.500000.jpg"));
  WriteKeyframeImages(keyframes, {});
  EXPECT_FALSE(std::filesystem::exists(keyframes));
}

TEST(WriteKeyframeImages, SaysWhereItCannotWrite) {
  const TestFolder folder;
  const auto file = folder.Write("file", "");
  EXPECT_THAT(ErrorOf([&] {
                WriteKeyframeImages(file, {{1, {'x'}}});
              }),
              testing::HasSubstr(file.string()));
}

}  // namespace
}  // namespace ofm
