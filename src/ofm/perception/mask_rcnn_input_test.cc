#include "ofm/perception/mask_rcnn_input.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace ofm {
namespace {

TEST(FitMaskRcnnInput, ShorterSideIsBroughtToTheTrainingSize) {
  const Letterbox landscape = FitMaskRcnnInput({640, 480}, {});
  EXPECT_EQ(landscape.resized, cv::Size(1067, 800));
  EXPECT_EQ(landscape.input, cv::Size(1067, 800));
  EXPECT_EQ(FitMaskRcnnInput({480, 640}, {}).resized, cv::Size(800, 1067));
}

TEST(FitMaskRcnnInput, LongerSideIsLimited) {
  EXPECT_EQ(FitMaskRcnnInput({2000, 500}, {}).resized, cv::Size(1333, 333));
  EXPECT_EQ(FitMaskRcnnInput({480, 640}, {.most = {1280, 960}}).resized, cv::Size(720, 960));
}

TEST(FitMaskRcnnInput, PaddingIsAtTheRightAndBelow) {
  const Letterbox letterbox = FitMaskRcnnInput({640, 480}, {.multiple = 32});
  EXPECT_EQ(letterbox.input, cv::Size(1088, 800));
  EXPECT_EQ(letterbox.upper_left, cv::Point(0, 0));
  EXPECT_DOUBLE_EQ(letterbox.ImageX(1067), 640);
  EXPECT_DOUBLE_EQ(letterbox.ImageY(800), 480);
}

TEST(FitMaskRcnnInput, FixedInputTakesTheWholeImage) {
  const Letterbox letterbox = FitMaskRcnnInput({640, 480}, {.fixed = {512, 512}, .multiple = 32});
  EXPECT_EQ(letterbox.input, cv::Size(512, 512));
  EXPECT_EQ(letterbox.resized, cv::Size(512, 384));
}

TEST(FitMaskRcnnInput, ImageStaysAsItIsWhereTheNetworkScales) {
  const Letterbox letterbox = FitMaskRcnnInput({641, 479}, {.shorter_side = 0});
  EXPECT_EQ(letterbox.resized, cv::Size(641, 479));
  EXPECT_EQ(letterbox.input, cv::Size(641, 479));
}

TEST(FitMaskRcnnInput, ThinImageKeepsAPixel) {
  EXPECT_EQ(FitMaskRcnnInput({4000, 1}, {}).resized, cv::Size(1333, 1));
}

float At(const cv::Mat& blob, int channel, int y, int x) { return blob.at<float>(channel, y, x); }

TEST(MaskRcnnBlob, ChannelsMeanAndScaleAreAsTheNetworkWantsThem) {
  const cv::Mat image(4, 6, CV_8UC3, cv::Scalar(10, 20, 30));  // BGR
  const Letterbox letterbox = FitMaskRcnnInput({6, 4}, {.fixed = {6, 4}});
  const cv::Mat rgb = MakeMaskRcnnBlob(letterbox, image, {.scale = 0.1});
  ASSERT_EQ(rgb.dims, 3);
  EXPECT_FLOAT_EQ(At(rgb, 0, 3, 5), 3);
  EXPECT_FLOAT_EQ(At(rgb, 2, 0, 0), 1);
  const cv::Mat bgr =
      MakeMaskRcnnBlob(letterbox, image, {MaskRcnnColors::Order::kBgr, cv::Scalar(1, 2, 3), 1});
  EXPECT_FLOAT_EQ(At(bgr, 0, 0, 0), 9);
  EXPECT_FLOAT_EQ(At(bgr, 1, 3, 5), 18);
  EXPECT_FLOAT_EQ(At(bgr, 2, 2, 2), 27);
}

TEST(MaskRcnnBlob, PaddingIsZeroEvenWhereAMeanIsSubtracted) {
  const cv::Mat image(4, 4, CV_8UC3, cv::Scalar::all(200));
  const Letterbox letterbox = FitMaskRcnnInput({4, 4}, {.fixed = {16, 8}});
  const cv::Mat blob =
      MakeMaskRcnnBlob(letterbox, image, {.mean = cv::Scalar::all(50), .scale = 2});
  EXPECT_FLOAT_EQ(At(blob, 1, 7, 7), 300);
  EXPECT_FLOAT_EQ(At(blob, 1, 7, 8), 0);
  EXPECT_FLOAT_EQ(At(blob, 2, 0, 15), 0);
}

TEST(MaskRcnnBlob, ImageOfAnotherSizeIsAProgrammersError) {
  const Letterbox letterbox = FitMaskRcnnInput({6, 4}, {});
  EXPECT_THROW(MakeMaskRcnnBlob(letterbox, cv::Mat(5, 6, CV_8UC3), {}), std::logic_error);
  EXPECT_THROW(MakeMaskRcnnBlob(letterbox, cv::Mat(4, 6, CV_8UC1), {}), std::logic_error);
}

}  // namespace
}  // namespace ofm
