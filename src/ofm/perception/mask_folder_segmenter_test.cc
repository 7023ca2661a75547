#include "ofm/perception/mask_folder_segmenter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "ofm/io/test_folder.h"
#include "ofm/perception/class_names.h"
#include "ofm/perception/instance_file.h"
#include "ofm/perception/test_support.h"

namespace ofm {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A folder with masks for frames of 40 x 30 px.
class MaskFolderSegmenterTest : public ::testing::Test {
 protected:
  MaskFolderSegmenter Segmenter() const {
    return MaskFolderSegmenter({folder_.path(), {}, "person"});
  }

  void WriteMask(const std::string& name, const cv::Mat& mask) const {
    ASSERT_TRUE(cv::imwrite((folder_.path() / (name + ".png")).string(), mask));
  }

  std::string SegmentError(const std::string& name) const {
    MaskFolderSegmenter segmenter = Segmenter();
    return ErrorOf([&] { segmenter.Segment(Frame(name)); });
  }

  static RgbdFrame Frame(const std::string& name) {
    return test::MakeFrame(cv::Mat::zeros(30, 40, CV_8UC3), name);
  }

  TestFolder folder_;
};

TEST_F(MaskFolderSegmenterTest, ListOfInstancesGoesBeforeAnImage) {
  WriteMask("1.5", cv::Mat::ones(30, 40, CV_8UC1));
  Segmentation written;
  written.instances.push_back({{}, ClassId(0), 0.25F, {}, cv::Mat::zeros(30, 40, CV_8UC1)});
  written.instances[0].mask(cv::Rect(3, 4, 5, 6)).setTo(255);
  SaveInstances(folder_.path() / "1.5.json", written, {"person"});
  const Segmentation read = Segmenter().Segment(Frame("1.5"));
  EXPECT_EQ(read.frame_id, FrameId(7));
  ASSERT_THAT(read.instances, SizeIs(1));
  EXPECT_EQ(read.instances[0].score, 0.25F);
  EXPECT_EQ(read.instances[0].box, cv::Rect(3, 4, 5, 6));
}

/// What was drawn comes back, for both depths of PNG.
TEST_F(MaskFolderSegmenterTest, InstancesComeBackAsTheyWereDrawn) {
  for (const int type : {CV_8UC1, CV_16UC1}) {
    SCOPED_TRACE(type);
    const std::uint32_t large_id = type == CV_8UC1 ? 200 : 40000;
    cv::Mat ids = cv::Mat::zeros(30, 40, type);
    const cv::Rect first(3, 4, 5, 6), second(20, 0, 20, 30);
    ids(second).setTo(cv::Scalar(large_id));
    ids(first).setTo(cv::Scalar(3));
    ids(cv::Rect(25, 10, 2, 2)).setTo(cv::Scalar(3));  // a second part of the first instance
    WriteMask("1.5", ids);

    const Segmentation segmentation = Segmenter().Segment(Frame("1.5"));
    EXPECT_EQ(segmentation.frame_id, FrameId(7));
    ASSERT_THAT(segmentation.instances, SizeIs(2));
    const Instance& small = segmentation.instances[0];
    const Instance& large = segmentation.instances[1];
    EXPECT_EQ(small.id, InstanceId(3));
    EXPECT_EQ(large.id, InstanceId(large_id));
    EXPECT_EQ(small.box, cv::Rect(3, 4, 24, 8));
    EXPECT_EQ(large.box, second);
    EXPECT_FLOAT_EQ(small.score, 1);
    EXPECT_EQ(small.mask.type(), CV_8UC1);
    EXPECT_EQ(cv::countNonZero(small.mask), 30 + 4);
    EXPECT_EQ(cv::countNonZero(small.mask != (ids == 3)), 0);
    EXPECT_EQ(cv::countNonZero(large.mask != (ids == static_cast<int>(large_id))), 0);
  }
}

TEST_F(MaskFolderSegmenterTest, EmptyMaskHasNoInstance) {
  WriteMask("1.5", cv::Mat::zeros(30, 40, CV_8UC1));
  EXPECT_THAT(Segmenter().Segment(Frame("1.5")).instances, IsEmpty());
}

TEST_F(MaskFolderSegmenterTest, ClassIsFoundInTheListOrAddedToIt) {
  cv::Mat ids = cv::Mat::zeros(30, 40, CV_8UC1);
  ids.at<std::uint8_t>(2, 2) = 1;
  WriteMask("1.5", ids);
  MaskFolderSegmenter dogs({folder_.path(), CocoClassNames(), "dog"});
  EXPECT_EQ(dogs.Segment(Frame("1.5")).instances.at(0).class_id, ClassId(16));
  EXPECT_EQ(dogs.class_names().size(), 80U);
  MaskFolderSegmenter robots({folder_.path(), CocoClassNames(), "robot"});
  EXPECT_EQ(robots.Segment(Frame("1.5")).instances.at(0).class_id, ClassId(80));
  EXPECT_EQ(robots.class_names().at(80), "robot");
}

TEST_F(MaskFolderSegmenterTest, MissingFolderIsNamed) {
  EXPECT_THAT(ErrorOf([] {
                MaskFolderSegmenter({"/no/such/mask", {}, "person"});
              }),
              HasSubstr("/no/such/mask: no such folder of masks"));
}

TEST_F(MaskFolderSegmenterTest, MissingMaskIsNamedWithWhatToDo) {
  EXPECT_THAT(SegmentError("2.5"), AllOf(HasSubstr("2.5.png: no mask"), HasSubstr("add the file")));
  EXPECT_THAT(SegmentError(""), HasSubstr("colour file's name"));
}

TEST_F(MaskFolderSegmenterTest, DamagedFileIsNamed) {
  folder_.Write("1.5.png", "this is no image");
  EXPECT_THAT(SegmentError("1.5"), HasSubstr("1.5.png: is neither a PNG"));
}

TEST_F(MaskFolderSegmenterTest, TruncatedFileIsNamed) {
  cv::Mat ids(30, 40, CV_8UC1);
  cv::randu(ids, 0, 9);
  WriteMask("1.5", ids);
  const auto path = folder_.path() / "1.5.png";
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_THAT(SegmentError("1.5"), HasSubstr("1.5.png: is "));
}

TEST_F(MaskFolderSegmenterTest, WrongSizeIsToldWithBothSizes) {
  WriteMask("1.5", cv::Mat::zeros(30, 41, CV_8UC1));
  EXPECT_THAT(SegmentError("1.5"), HasSubstr("1.5.png: is 41 x 30 px but its frame is 40 x 30"));
}

TEST_F(MaskFolderSegmenterTest, ColourImageIsNoMask) {
  WriteMask("1.5", cv::Mat::zeros(30, 40, CV_8UC3));
  EXPECT_THAT(SegmentError("1.5"), HasSubstr("1.5.png: is CV_8UC3; a mask has one channel"));
}

TEST_F(MaskFolderSegmenterTest, DepthImageIsNoMask) {
  cv::Mat depth(30, 40, CV_16UC1);
  for (int i = 0; i < 30 * 40; ++i) depth.at<std::uint16_t>(i) = static_cast<std::uint16_t>(i);
  WriteMask("1.5", depth);
  EXPECT_THAT(SegmentError("1.5"), HasSubstr("1.5.png: has over 255 instances"));
}

}  // namespace
}  // namespace ofm
