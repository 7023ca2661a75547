#include "ofm/perception/dnn_network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core/utils/logger.hpp>

#include "ofm/io/test_folder.h"
#include "ofm/perception/test_support.h"

namespace ofm {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

std::string LoadError(std::string_view bytes, cv::Size input = {}) {
  const TestFolder folder;
  const auto path = folder.Write("net.onnx", bytes);
  return ErrorOf([&] { DnnNetwork(path, input); });
}

TEST(DnnNetwork, GetsRedGreenBlueBetweenZeroAndOne) {
  const TestFolder folder;
  DnnNetwork network(folder.Write("net.onnx", test::MakeYoloNetwork()));
  EXPECT_EQ(network.input_size(), cv::Size(64, 32));
  cv::Mat image(32, 64, CV_8UC3, cv::Scalar(0, 0, 0));
  image(cv::Rect(8, 0, 8, 8)).setTo(cv::Scalar(0, 102, 204));  // BGR, in the second cell
  network.Run(image);
  const std::vector<cv::Mat>& outputs = network.outputs();
  ASSERT_THAT(outputs, SizeIs(2));
  const cv::Mat cells = outputs[0].reshape(1, 7);
  EXPECT_NEAR(cells.at<float>(4, 1), 204 / 255.0, 1e-5);
  EXPECT_NEAR(cells.at<float>(5, 1), 102 / 255.0, 1e-5);
  EXPECT_NEAR(cells.at<float>(4, 0), 0, 1e-5);
}

TEST(DnnNetwork, ThreadsDoNotChangeTheOutputs) {
  const TestFolder folder;
  DnnNetwork network(folder.Write("net.onnx", test::MakeYoloNetwork()));
  cv::Mat image;
  cv::cvtColor(test::MakeTexture({64, 32}, 1), image, cv::COLOR_GRAY2BGR);
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  network.Run(image);
  const cv::Mat one = network.outputs()[0].clone();
  cv::setNumThreads(2);
  network.Run(image);
  const cv::Mat two = network.outputs()[0].clone();
  cv::setNumThreads(threads);
  EXPECT_EQ(std::memcmp(one.data, two.data, one.total() * sizeof(float)), 0);
}

TEST(DnnNetwork, MissingFileIsNamed) {
  EXPECT_THAT(ErrorOf([] { DnnNetwork("/no/such/net.onnx"); }),
              HasSubstr("/no/such/net.onnx: does not exist"));
  EXPECT_THAT(ErrorOf([] { DnnNetwork(std::filesystem::temp_directory_path()); }),
              HasSubstr("is a folder, not a file"));
  EXPECT_THAT(ErrorOf([] { DnnNetwork(""); }), HasSubstr("set perception.model"));
}

TEST(DnnNetwork, WhatOpenCvCannotLoadIsOneLine) {
  const test::Message graph = test::Message()
                                  .Add(1, test::OnnxNode("NoSuchOperation", {"images"}, "output"))
                                  .Bytes(2, "odd")
                                  .Add(11, test::OnnxValue("images", {1, 3, 32, 32}))
                                  .Add(12, test::OnnxValue("output", {1, 3, 32, 32}));
  const auto level = cv::utils::logging::getLogLevel();
  const std::string error = LoadError(test::OnnxModel(graph));
  EXPECT_THAT(error,
              AllOf(HasSubstr("net.onnx: OpenCV cannot load this network"), Not(HasSubstr("\n"))));
  EXPECT_EQ(cv::utils::logging::getLogLevel(), level) << "it belongs to the process";
}

TEST(DnnNetwork, NoNetworkIsOneLineAndNothingOnStderr) {
  ::testing::internal::CaptureStderr();
  const std::string text = LoadError("a text\n"), empty = LoadError("");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(text, HasSubstr("net.onnx: is no ONNX network"));
  EXPECT_THAT(empty, HasSubstr("net.onnx: is no ONNX network"));
}

TEST(DnnNetwork, InputMustBeOneColourImage) {
  EXPECT_THAT(LoadError(test::MakeYoloNetwork({.input_shape = {1, 1, 32, 64}})),
              HasSubstr("net.onnx: does not take one colour image"));
}

TEST(DnnNetwork, OpenInputSizeMustBeGiven) {
  const std::string bytes = test::MakeYoloNetwork({.input_shape = {1, 3, 0, 0}});
  EXPECT_THAT(LoadError(bytes), HasSubstr("set perception.input_width and input_height"));
  EXPECT_EQ(LoadError(bytes, {64, 32}), "");
}

TEST(DnnNetwork, SizeThatTheNetworkCannotTakeIsOneLine) {
  const std::string error = LoadError(test::MakeYoloNetwork(), {40, 40});
  EXPECT_THAT(error, AllOf(HasSubstr("net.onnx: OpenCV cannot run this network at 40 x 40 px"),
                           Not(HasSubstr("\n"))));
}

TEST(DnnNetwork, ImageOfAnotherSizeIsAProgrammersError) {
  const TestFolder folder;
  DnnNetwork network(folder.Write("net.onnx", test::MakeYoloNetwork()));
  EXPECT_THROW(network.Run(cv::Mat(40, 40, CV_8UC3)), std::logic_error);
}

}  // namespace
}  // namespace ofm
