#include "ofm/perception/yolo_seg_segmenter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "ofm/io/test_folder.h"
#include "ofm/perception/class_names.h"
#include "ofm/perception/test_support.h"

namespace ofm {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

class SmallNetwork : public ::testing::Test {
 protected:
  YoloSegSegmenter Segmenter(const test::YoloNetwork& network = {}) const {
    return YoloSegSegmenter(
        {folder_.Write("net.onnx", test::MakeYoloNetwork(network)), {"red", "green"}, {}},
        {.score_threshold = 0.5});
  }

  TestFolder folder_;
};

/// The network's box is x 12 to 52, y 8 to 24; its mask is where the image is blue.
TEST_F(SmallNetwork, InstanceIsWhereTheNetworkSaysIt) {
  cv::Mat image(32, 64, CV_8UC3, cv::Scalar(0, 0, 0));
  image(cv::Rect(0, 0, 32, 32)).setTo(cv::Scalar(255, 0, 0));
  image(cv::Rect(40, 0, 8, 8)).setTo(cv::Scalar(0, 204, 0));
  cv::Mat expected = cv::Mat::zeros(32, 64, CV_8UC1);
  expected(cv::Rect(12, 8, 20, 16)).setTo(255);
  for (const bool prototypes_first : {false, true}) {
    const auto segmentation =
        Segmenter({.prototypes_first = prototypes_first}).Segment(test::MakeFrame(image));
    EXPECT_EQ(segmentation.frame_id, FrameId(7));
    ASSERT_THAT(segmentation.instances, SizeIs(1));
    EXPECT_EQ(segmentation.instances[0].class_id, ClassId(1));
    EXPECT_NEAR(segmentation.instances[0].score, 0.8F, 1e-4);
    EXPECT_EQ(cv::countNonZero(segmentation.instances[0].mask != expected), 0);
  }
}

/// 128 x 128 px become 32 x 32, 16 px from the left: the image's x is (12 - 16) * 4 < 0 to
/// (52 - 16) * 4, cut at 128; y is 8 * 4 = 32 to 24 * 4 = 96.
TEST_F(SmallNetwork, FrameOfAnotherShapeIsLetterboxed) {
  const cv::Mat image(128, 128, CV_8UC3, cv::Scalar(255, 204, 0));
  const auto segmentation = Segmenter().Segment(test::MakeFrame(image));
  ASSERT_THAT(segmentation.instances, SizeIs(1));
  EXPECT_EQ(segmentation.instances[0].box, cv::Rect(0, 32, 128, 64));
  EXPECT_EQ(segmentation.instances[0].mask.size(), cv::Size(128, 128));
  EXPECT_EQ(cv::countNonZero(segmentation.instances[0].mask), 128 * 64);
}

TEST_F(SmallNetwork, NetworkWithoutMasksIsRefusedAtOnce) {
  EXPECT_THAT(ErrorOf([&] { Segmenter({.has_prototypes = false}); }),
              AllOf(HasSubstr("net.onnx: the outputs (1x7x32) are not those of a YOLO"),
                    Not(HasSubstr("\n"))));
}

TEST_F(SmallNetwork, ClassesMustHaveNames) {
  const auto path = folder_.Write("net.onnx", test::MakeYoloNetwork());
  EXPECT_THAT(ErrorOf([&] {
                YoloSegSegmenter({path, CocoClassNames(), {}}, {});
              }),
              HasSubstr("net.onnx: the network tells 2 classes apart but 80 have a name"));
}

class RealNetworks : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(Model())) GTEST_SKIP() << Model() << " is absent";
  }
  static std::filesystem::path Model() {
    return std::filesystem::path(OFM_SHARED_DIR) / "models" / GetParam();
  }
  static std::vector<std::filesystem::path> Stills() {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(
             std::filesystem::path(OFM_SHARED_DIR) / "data/tum_fr3_stills")) {
      paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    paths.resize(std::min<std::size_t>(paths.size(), 3));  // keeps the test short
    return paths;
  }
};

cv::Mat PeopleIn(const Segmentation& segmentation, cv::Size size, int& count) {
  cv::Mat people = cv::Mat::zeros(size, CV_8UC1);
  count = 0;
  for (const Instance& instance : segmentation.instances) {
    if (instance.class_id != ClassId(0)) continue;
    people.setTo(255, instance.mask);
    ++count;
  }
  return people;
}

/// Two people sit through the stills, 30 a second, while the camera moves by about 10 px from one
/// to the next.
TEST_P(RealNetworks, PeopleAreFoundAndTheirMasksAreSteady) {
  YoloSegSegmenter segmenter({Model(), CocoClassNames(), {}}, {});
  cv::Mat last;
  for (const auto& path : Stills()) {
    SCOPED_TRACE(path);
    const cv::Mat color = cv::imread(path.string());
    int count = 0;
    const cv::Mat people = PeopleIn(segmenter.Segment(test::MakeFrame(color)), color.size(), count);
    EXPECT_GE(count, 2);
    const double share = cv::countNonZero(people) / static_cast<double>(people.total());
    EXPECT_GT(share, 0.12);  // about a sixth by eye
    EXPECT_LT(share, 0.25);
    if (!last.empty()) {
      const double common = cv::countNonZero(people & last),
                   either = cv::countNonZero(people | last);
      EXPECT_GT(common / either, 0.70);
    }
    last = people;
  }
}

TEST_P(RealNetworks, SameImageGivesTheSameInstances) {
  YoloSegSegmenter segmenter({Model(), CocoClassNames(), {}}, {});
  const auto frame = test::MakeFrame(cv::imread(Stills().front().string()));
  const auto first = segmenter.Segment(frame), second = segmenter.Segment(frame);
  ASSERT_EQ(first.instances.size(), second.instances.size());
  for (std::size_t i = 0; i < first.instances.size(); ++i) {
    EXPECT_EQ(first.instances[i].score, second.instances[i].score);
    EXPECT_EQ(cv::countNonZero(first.instances[i].mask != second.instances[i].mask), 0);
  }
}

TEST_P(RealNetworks, FileThatEndsTooEarlyIsRefused) {
  std::ifstream file(Model(), std::ios::binary);
  std::string bytes(2000000, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  const TestFolder folder;
  const auto path = folder.Write("half.onnx", bytes);
  EXPECT_THAT(ErrorOf([&] {
                YoloSegSegmenter({path, CocoClassNames(), {}}, {});
              }),
              HasSubstr("half.onnx: is no ONNX network or ends too early"));
}

INSTANTIATE_TEST_SUITE_P(Shared, RealNetworks,
                         ::testing::Values("yolov8n-seg_480x640.onnx", "yolov8n-seg_256x320.onnx",
                                           "yolo11n-seg_384x512.onnx"),
                         [](const auto& test_info) {
                           const std::string name = test_info.param;
                           return name.substr(0, name.find('-')) + "_" +
                                  name.substr(name.find('_') + 1, 7);
                         });

}  // namespace
}  // namespace ofm
