#include "ofm/perception/onnx_header.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/io/test_folder.h"
#include "ofm/perception/test_support.h"

namespace ofm {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

std::vector<OnnxInput> Read(std::string_view bytes) { return ReadOnnxInputs(bytes, "net.onnx"); }
std::string ReadError(std::string_view bytes) {
  return ErrorOf([&] { Read(bytes); });
}

TEST(OnnxHeader, TellsNameAndShapeOfTheInput) {
  const auto inputs = Read(test::MakeYoloNetwork());
  ASSERT_THAT(inputs, SizeIs(1));
  EXPECT_EQ(inputs[0].name, "images");
  EXPECT_THAT(inputs[0].shape, ElementsAre(1, 3, 32, 64));
}

TEST(OnnxHeader, OpenDimensionsAreZero) {
  EXPECT_THAT(Read(test::MakeYoloNetwork({.input_shape = {0, 3, 0, 640}})).at(0).shape,
              ElementsAre(0, 3, 0, 640));
}

TEST(OnnxHeader, WeightsListedAmongTheInputsAreLeftOut) {
  const test::Message graph = test::Message()
                                  .Add(11, test::OnnxValue("weights", {8, 3, 3, 3}))
                                  .Add(11, test::OnnxValue("images", {1, 3, 64, 96}))
                                  .Add(5, test::OnnxWeights("weights", {1}, {0.5F}));
  const auto inputs = Read(test::OnnxModel(graph));
  ASSERT_THAT(inputs, SizeIs(1));
  EXPECT_EQ(inputs[0].name, "images");
}

TEST(OnnxHeader, OtherFilesAreRefused) {
  EXPECT_THAT(ReadError(""), HasSubstr("net.onnx: is no ONNX network"));
  EXPECT_THAT(ReadError("not a network at all\n"), HasSubstr("net.onnx: is no ONNX network"));
  EXPECT_THAT(ReadError("\x89PNG\r\n\x1a\n"), HasSubstr("net.onnx: is no ONNX network"));
  EXPECT_THAT(ReadError(test::OnnxModel(test::Message())), HasSubstr("it has no input"));
}

TEST(OnnxHeader, EveryTruncatedFileIsRefused) {
  const std::string bytes = test::MakeYoloNetwork();
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 64) {
    EXPECT_THAT(ReadError(std::string_view(bytes).substr(0, size)), HasSubstr("net.onnx: is no"))
        << size;
  }
}

TEST(OnnxHeader, RandomBytesAreRefusedOrReadButNeverCrash) {
  RandomEngine engine = MakeRandomEngine(3, 0);
  int refused = 0;
  for (int round = 0; round < 500; ++round) {
    std::string bytes = test::MakeYoloNetwork();
    for (int k = 0; k < 5; ++k) {
      bytes[UniformIndex(engine, static_cast<std::uint32_t>(bytes.size()))] =
          static_cast<char>(UniformIndex(engine, 256));
    }
    refused += !ReadError(bytes).empty();
    std::string noise(200, '\0');
    for (char& c : noise) c = static_cast<char>(UniformIndex(engine, 256));
    refused += !ReadError(noise).empty();
  }
  EXPECT_GE(refused, 450);
}

}  // namespace
}  // namespace ofm
