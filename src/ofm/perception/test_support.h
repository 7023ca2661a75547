// Made images, files and networks for tests.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ofm/base/random.h"
#include "ofm/camera/rgbd_frame.h"

namespace ofm::test {

/// Smooth random grey texture, corners everywhere.
inline cv::Mat MakeTexture(cv::Size size, std::uint64_t seed) {
  RandomEngine engine = MakeRandomEngine(seed, 0);
  cv::Mat noise(size, CV_8UC1), texture;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      noise.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(UniformIndex(engine, 256));
    }
  }
  cv::GaussianBlur(noise, texture, {}, 2.5);
  cv::normalize(texture, texture, 0, 255, cv::NORM_MINMAX);
  return texture;
}

inline RgbdFrame MakeFrame(const cv::Mat& color, std::string name = "1.5") {
  RgbdFrame frame;
  frame.id = FrameId(7);
  frame.name = std::move(name);
  frame.color = color;
  cv::cvtColor(color, frame.gray, cv::COLOR_BGR2GRAY);
  frame.depth_m = cv::Mat::zeros(color.size(), CV_32FC1);
  return frame;
}

/// Writes protocol-buffer messages, as far as ONNX files need them.
class Message {
 public:
  Message& Number(std::uint64_t field, std::uint64_t value) {
    Varint(field << 3);
    Varint(value);
    return *this;
  }
  Message& Bytes(std::uint64_t field, std::string_view bytes) {
    Varint(field << 3 | 2);
    Varint(bytes.size());
    bytes_ += bytes;
    return *this;
  }
  Message& Add(std::uint64_t field, const Message& message) { return Bytes(field, message.bytes_); }
  const std::string& bytes() const { return bytes_; }

 private:
  void Varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) bytes_ += static_cast<char>((value & 0x7F) | 0x80);
    bytes_ += static_cast<char>(value);
  }
  std::string bytes_;
};

/// A graph's input or output; a dimension of 0 is left open.
inline Message OnnxValue(std::string_view name, const std::vector<int>& shape) {
  Message dimensions;
  for (const int size : shape) {
    dimensions.Add(1, size > 0 ? Message().Number(1, size) : Message().Bytes(2, "open"));
  }
  return Message().Bytes(1, name).Add(2,
                                      Message().Add(1, Message().Number(1, 1).Add(2, dimensions)));
}

inline Message OnnxWeights(std::string_view name, const std::vector<int>& shape,
                           const std::vector<float>& values) {
  Message tensor;
  for (const int size : shape) tensor.Number(1, size);
  std::string raw(values.size() * sizeof(float), '\0');
  std::memcpy(raw.data(), values.data(), raw.size());
  return tensor.Number(2, 1).Bytes(8, name).Bytes(9, raw);
}

inline Message OnnxIntegers(std::string_view name, const std::vector<std::int64_t>& values) {
  Message tensor;
  tensor.Number(1, values.size()).Number(2, 7).Bytes(8, name);
  std::string raw(values.size() * sizeof(std::int64_t), '\0');
  std::memcpy(raw.data(), values.data(), raw.size());
  return tensor.Bytes(9, raw);
}

inline Message OnnxNode(std::string_view type, const std::vector<std::string>& inputs,
                        const std::string& output) {
  Message node;
  for (const std::string& input : inputs) node.Bytes(1, input);
  return node.Bytes(2, output).Bytes(3, output).Bytes(4, type);
}

/// A convolution with square windows that do not overlap.
inline Message OnnxConvolution(const std::vector<std::string>& inputs, const std::string& output,
                               int window) {
  const auto integers = [&](std::string_view name) {
    return Message().Bytes(1, name).Number(8, window).Number(8, window).Number(20, 7);
  };
  return OnnxNode("Conv", inputs, output)
      .Add(5, integers("kernel_shape"))
      .Add(5, integers("strides"));
}

inline std::string OnnxModel(const Message& graph) {
  return Message().Number(1, 8).Add(8, Message().Bytes(1, "").Number(2, 13)).Add(7, graph).bytes();
}

/// What MakeYoloNetwork leaves out or changes.
struct YoloNetwork {
  std::vector<int> input_shape = {1, 3, 32, 64};
  bool has_prototypes = true;
  bool prototypes_first = false;
};

/// A real network in the Ultralytics segmentation layout, with known answers. Input 64 × 32, cells
/// of 8 × 8 px, 2 classes, 1 prototype of 16 × 8. Each cell has the box (32, 16, 40, 16), the
/// probabilities (mean red, mean green) of its pixels and the coefficient 1; the prototype is
/// 20 · blue − 10.
inline std::string MakeYoloNetwork(const YoloNetwork& options = {}) {
  constexpr int kRows = 4 + 2 + 1, kCell = 8, kCells = 32, kStride = 4;
  std::vector<float> cell_weights(kRows * 3 * kCell * kCell, 0.0F);
  const auto mean_of = [&](int row, int channel) {
    const int begin = (row * 3 + channel) * kCell * kCell;
    std::fill_n(cell_weights.begin() + begin, kCell * kCell, 1.0F / (kCell * kCell));
  };
  mean_of(4, 0);
  mean_of(5, 1);
  std::vector<float> prototype_weights(3 * kStride * kStride, 0.0F);
  std::fill_n(prototype_weights.begin() + 2 * kStride * kStride, kStride * kStride,
              20.0F / (kStride * kStride));
  Message graph;
  graph.Add(1, OnnxConvolution({"images", "cell_weights", "cell_bias"}, "grid", kCell))
      .Add(1, OnnxNode("Reshape", {"grid", "shape"}, "output0"));
  if (options.has_prototypes) {
    graph.Add(1, OnnxConvolution({"images", "proto_weights", "proto_bias"}, "output1", kStride));
  }
  graph.Bytes(2, "small")
      .Add(5, OnnxWeights("cell_weights", {kRows, 3, kCell, kCell}, cell_weights))
      .Add(5, OnnxWeights("cell_bias", {kRows}, {32, 16, 40, 16, 0, 0, 1}))
      .Add(5, OnnxIntegers("shape", {1, kRows, kCells}))
      .Add(5, OnnxWeights("proto_weights", {1, 3, kStride, kStride}, prototype_weights))
      .Add(5, OnnxWeights("proto_bias", {1}, {-10}))
      .Add(11, OnnxValue("images", options.input_shape));
  const Message cells = OnnxValue("output0", {1, kRows, kCells});
  const Message prototypes = OnnxValue("output1", {1, 1, 8, 16});
  if (options.prototypes_first) graph.Add(12, prototypes);
  graph.Add(12, cells);
  if (options.has_prototypes && !options.prototypes_first) graph.Add(12, prototypes);
  return OnnxModel(graph);
}

}  // namespace ofm::test
