#include "ofm/io/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "ofm/base/error.h"
#include "ofm/io/read_file.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using testing::AnyOf;
using testing::EndsWith;
using testing::HasSubstr;

cv::Mat Gradient(int type) {
  cv::Mat image(24, 32, type);
  for (int i = 0; i < image.rows; ++i) image.row(i).setTo(cv::Scalar::all(10 * i));
  return image;
}

std::filesystem::path WriteImage(const TestFolder& folder, const std::string& name,
                                 const cv::Mat& image) {
  const auto path = folder.path() / name;
  cv::imwrite(path.string(), image);
  return path;
}

TEST(ImageFile, ReadsColourInBgrOrder) {
  const TestFolder folder;
  const cv::Mat blue(24, 32, CV_8UC3, cv::Scalar(250, 20, 10));
  const cv::Mat png = LoadColorImage(WriteImage(folder, "a.png", blue));
  EXPECT_EQ(png.at<cv::Vec3b>(3, 4), cv::Vec3b(250, 20, 10));
  const cv::Mat jpeg = LoadColorImage(WriteImage(folder, "a.jpg", blue));
  EXPECT_EQ(jpeg.size(), cv::Size(32, 24));
  EXPECT_GT(jpeg.at<cv::Vec3b>(3, 4)[0], 240);
}

TEST(ImageFile, ReadsDepthInMetres) {
  const TestFolder folder;
  cv::Mat depth(24, 32, CV_16UC1, cv::Scalar(0));
  depth.at<std::uint16_t>(2, 5) = 7500;
  depth.at<std::uint16_t>(3, 5) = 65535;
  const cv::Mat depth_m = LoadDepthImage(WriteImage(folder, "d.png", depth), 5000);
  ASSERT_EQ(depth_m.type(), CV_32FC1);
  EXPECT_EQ(depth_m.at<float>(0, 0), 0);
  EXPECT_FLOAT_EQ(depth_m.at<float>(2, 5), 1.5f);
  EXPECT_FLOAT_EQ(depth_m.at<float>(3, 5), 13.107f);
}

TEST(ImageFile, EveryTruncationIsFound) {
  const TestFolder folder;
  for (const char* name : {"a.png", "a.jpg"}) {
    const std::string whole = ReadFile(WriteImage(folder, name, Gradient(CV_8UC3)));
    for (std::size_t size = 1; size < whole.size(); size += 7) {
      const auto path = folder.Write(name, whole.substr(0, size));
      EXPECT_THAT(ErrorOf([&] { LoadImage(path); }),
                  AnyOf(EndsWith("bytes; copy or download it again"),
                        EndsWith("is neither a PNG nor a JPEG image")))
          << size << " of " << whole.size();
    }
    const auto path = folder.Write(name, whole.substr(0, whole.size() - 1));
    EXPECT_THAT(ErrorOf([&] { LoadImage(path); }),
                HasSubstr(path.string() + ": is truncated after " +
                          std::to_string(whole.size() - 1) + " bytes"));
  }
}

TEST(ImageFile, PaddingAtTheEndIsNoTruncation) {
  const TestFolder folder;
  const std::string padding(5, '\0');
  for (const char* name : {"a.png", "a.jpg"}) {
    const std::string whole = ReadFile(WriteImage(folder, name, Gradient(CV_8UC3)));
    EXPECT_EQ(LoadImage(folder.Write(name, whole + padding)).rows, 24);
  }
}

TEST(ImageFile, DamageInTheMiddleOfAPngIsFound) {
  const TestFolder folder;
  std::string bytes = ReadFile(WriteImage(folder, "a.png", Gradient(CV_16UC1)));
  bytes[bytes.find("IDAT") + 8] ^= 0x55;
  const auto path = folder.Write("a.png", bytes);
  EXPECT_THAT(ErrorOf([&] { LoadImage(path); }), HasSubstr("a.png: is damaged"));
}

TEST(ImageFile, WhatIsNoImageIsNamed) {
  const TestFolder folder;
  EXPECT_THAT(ErrorOf([&] { LoadImage(folder.path() / "none.png"); }),
              EndsWith("none.png: does not exist; check the path"));
  EXPECT_THAT(ErrorOf([&] { LoadImage(folder.Write("text.png", "no picture")); }),
              EndsWith("text.png: is neither a PNG nor a JPEG image"));
  EXPECT_THAT(ErrorOf([&] { LoadImage(folder.Write("zero.png", "")); }),
              HasSubstr("zero.png: is empty"));
}

TEST(ImageFile, WrongKindsAreNamed) {
  const TestFolder folder;
  const auto gray = WriteImage(folder, "gray.png", Gradient(CV_8UC1));
  const auto color = WriteImage(folder, "color.png", Gradient(CV_8UC3));
  const auto deep = WriteImage(folder, "deep.png", Gradient(CV_16UC3));
  const auto depth = WriteImage(folder, "depth.png", Gradient(CV_16UC1));
  EXPECT_THAT(ErrorOf([&] { LoadColorImage(gray); }),
              HasSubstr("gray.png: has 1 channel of 8 bits, but a colour image"));
  EXPECT_THAT(ErrorOf([&] { LoadColorImage(deep); }), HasSubstr("3 channels of 16 bits"));
  EXPECT_THAT(ErrorOf([&] { LoadColorImage(depth); }), HasSubstr("1 channel of 16 bits"));
  EXPECT_THAT(ErrorOf([&] { LoadDepthImage(gray, 5000); }),
              HasSubstr("gray.png: has 1 channel of 8 bits, but a depth image"));
  EXPECT_THAT(ErrorOf([&] { LoadDepthImage(color, 5000); }), HasSubstr("3 channels of 8 bits"));
  EXPECT_THAT(ErrorOf([&] { LoadDepthImage(deep, 5000); }), HasSubstr("3 channels of 16 bits"));
}

TEST(ImageFile, AMaskHasOneByteAPixelAndTheFramesSize) {
  const TestFolder folder;
  const cv::Mat ids = Gradient(CV_8UC1);
  const auto mask = WriteImage(folder, "mask.png", ids);
  EXPECT_EQ(cv::norm(LoadMaskImage(mask, ids.size()), ids, cv::NORM_INF), 0);
  EXPECT_THAT(ErrorOf([&] {
                LoadMaskImage(mask, {7, 5});
              }),
              HasSubstr("mask.png: is no 8-bit instance mask of the frame's size"));
  const auto deep = WriteImage(folder, "deep.png", Gradient(CV_16UC1));
  EXPECT_THAT(ErrorOf([&] { LoadMaskImage(deep, ids.size()); }),
              HasSubstr("deep.png: is no 8-bit"));
}

}  // namespace
}  // namespace ofm
