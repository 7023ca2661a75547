// Small Mask R-CNNs for tests, with the inputs and outputs of the real ones and known answers.
#pragma once

#include <fmt/format.h>

#include <cstring>
#include <string>
#include <vector>

#include "ofm/perception/test_support.h"

namespace ofm::test {

/// A constant of a TensorFlow graph. Weights are in its order, height × width × in × out.
inline Message TensorflowConstant(std::string_view name, const std::vector<int>& shape,
                                  const std::vector<float>& values) {
  Message dimensions;
  for (const int size : shape) dimensions.Add(2, Message().Number(1, size));
  std::string raw(values.size() * sizeof(float), '\0');
  std::memcpy(raw.data(), values.data(), raw.size());
  const Message tensor = Message().Number(1, 1).Add(2, dimensions).Bytes(4, raw);
  return Message()
      .Bytes(1, name)
      .Bytes(2, "Const")
      .Add(5, Message().Bytes(1, "value").Add(2, Message().Add(8, tensor)));
}

/// A node of a TensorFlow text graph; `attributes` as the format writes them.
inline std::string TensorflowNode(
    std::string_view name, std::string_view op, const std::vector<std::string>& inputs,
    const std::vector<std::pair<std::string, std::string>>& attributes = {}) {
  std::string text = fmt::format("node {{\n  name: \"{}\"\n  op: \"{}\"\n", name, op);
  for (const std::string& input : inputs) text += fmt::format("  input: \"{}\"\n", input);
  for (const auto& [key, value] : attributes) {
    text += fmt::format("  attr {{ key: \"{}\" value {{ {} }} }}\n", key, value);
  }
  return text + "}\n";
}

inline std::string TensorflowReals(const std::vector<float>& values) {
  std::string text =
      fmt::format("tensor {{ dtype: DT_FLOAT tensor_shape {{ dim {{ size: {} }} }}", values.size());
  for (const float value : values) text += fmt::format(" float_val: {}", value);
  return text + " }";
}

inline std::string TensorflowWholes(const std::vector<int>& values) {
  std::string text =
      fmt::format("tensor {{ dtype: DT_INT32 tensor_shape {{ dim {{ size: {} }} }}", values.size());
  for (const int value : values) text += fmt::format(" int_val: {}", value);
  return text + " }";
}

/// A convolution whose windows do not overlap.
inline std::string TensorflowConvolution(const std::string& name, const std::string& input,
                                         int stride) {
  return TensorflowNode(name, "Conv2D", {input, name + "/weights"},
                        {{"data_format", "s: \"NHWC\""},
                         {"padding", "s: \"VALID\""},
                         {"strides", fmt::format("list {{ i: 1 i: {0} i: {0} i: 1 }}", stride)}});
}

struct TensorflowNetwork {
  std::string graph;       ///< frozen graph (.pb)
  std::string text_graph;  ///< (.pbtxt)
};

/// Two classes of 90 are seen in each cell of 16 × 16 px: 0 (COCO's label 1, person) with the mean
/// red as its score and 61 (label 62, chair) with the mean green. The box is 40 × 24 px around the
/// cell's centre, cut at the border; a person's mask is where blue exceeds 1/2, a chair's where it
/// does not. The last layers are those of mask_rcnn_inception_v2_coco: PriorBox, DetectionOutput
/// (scores from 0.3), CropAndResize to 15 × 15, a convolution and a sigmoid.
inline TensorflowNetwork MakeTensorflowMaskRcnn(int class_count = 90) {
  constexpr int kCell = 16, kStride = 4, kCrop = 15;
  const int chair = std::min(61, class_count - 1);
  std::vector<float> scores(static_cast<std::size_t>(kCell * kCell * 3 * class_count), 0.0F);
  std::vector<float> features(kStride * kStride * 3, 0.0F);
  for (int pixel = 0; pixel < kCell * kCell; ++pixel) {
    scores[(pixel * 3 + 0) * class_count + 0] = 1 / 255.0F / (kCell * kCell);
    scores[(pixel * 3 + 1) * class_count + chair] = 1 / 255.0F / (kCell * kCell);
  }
  for (int pixel = 0; pixel < kStride * kStride; ++pixel) {
    features[pixel * 3 + 2] = 1 / 255.0F / (kStride * kStride);
  }
  std::vector<float> mask_weights(class_count, 0.0F), mask_biases(class_count, -10.0F);
  mask_weights[0] = 20, mask_weights[chair] = -20, mask_biases[chair] = 10;

  TensorflowNetwork network;
  network.graph =
      Message()
          .Add(1, TensorflowConstant("scores/weights", {kCell, kCell, 3, class_count}, scores))
          .Add(1, TensorflowConstant("boxes/weights", {kCell, kCell, 3, 4},
                                     std::vector<float>(kCell * kCell * 3 * 4, 0.0F)))
          .Add(1, TensorflowConstant("features/weights", {kStride, kStride, 3, 1}, features))
          .Add(1, TensorflowConstant("masks/weights", {1, 1, 1, class_count}, mask_weights))
          .Add(1, TensorflowConstant("masks/biases", {class_count}, mask_biases))
          .bytes();
  network.text_graph =
      TensorflowNode("image_tensor", "Placeholder", {},
                     {{"dtype", "type: DT_UINT8"},
                      {"shape",
                       "shape { dim { size: -1 } dim { size: -1 } dim { size: -1 } dim { "
                       "size: 3 } }"}}) +
      TensorflowConvolution("scores", "image_tensor", kCell) +
      TensorflowConvolution("boxes", "image_tensor", kCell) +
      TensorflowConvolution("features", "image_tensor", kStride) +
      TensorflowNode("scores/flatten", "Flatten", {"scores"}) +
      TensorflowNode("boxes/flatten", "Flatten", {"boxes"}) +
      TensorflowNode("proposals", "PriorBox", {"boxes", "image_tensor"},
                     {{"clip", "b: true"},
                      {"flip", "b: false"},
                      {"height", TensorflowReals({24})},
                      {"width", TensorflowReals({40})},
                      {"offset", "f: 0.5"},
                      {"step", fmt::format("f: {}", kCell)},
                      {"variance", TensorflowReals({0.1F, 0.1F, 0.2F, 0.2F})}}) +
      TensorflowNode("detection_out_final", "DetectionOutput",
                     {"boxes/flatten", "scores/flatten", "proposals"},
                     {{"background_label_id", fmt::format("i: {}", class_count + 1)},
                      {"clip", "b: true"},
                      {"code_type", "s: \"CENTER_SIZE\""},
                      {"confidence_threshold", "f: 0.3"},
                      {"group_by_classes", "b: false"},
                      {"keep_top_k", "i: 5"},
                      {"nms_threshold", "f: 0.6"},
                      {"num_classes", fmt::format("i: {}", class_count)},
                      {"share_location", "b: true"}}) +
      TensorflowNode("crop_size", "Const", {}, {{"value", TensorflowWholes({kCrop, kCrop})}}) +
      TensorflowNode("CropAndResize_1", "CropAndResize",
                     {"features", "detection_out_final", "crop_size"},
                     {{"extrapolation_value", "f: 0.0"}, {"method", "s: \"bilinear\""}}) +
      TensorflowConvolution("masks", "CropAndResize_1", 1) +
      TensorflowNode("masks/BiasAdd", "BiasAdd", {"masks", "masks/biases"},
                     {{"data_format", "s: \"NHWC\""}}) +
      TensorflowNode("detection_masks", "Sigmoid", {"masks/BiasAdd"});
  return network;
}

/// A constant as an output.
inline Message OnnxOutput(const std::string& constant, const std::string& output) {
  return OnnxNode("Identity", {constant}, output);
}

inline Message OnnxTypedValue(std::string_view name, int type, const std::vector<int>& shape) {
  Message dimensions;
  for (const int size : shape) {
    dimensions.Add(1, size > 0 ? Message().Number(1, size) : Message().Bytes(2, name));
  }
  return Message().Bytes(1, name).Add(
      2, Message().Add(1, Message().Number(1, type).Add(2, dimensions)));
}

/// A tensor of 64-bit whole numbers.
inline Message OnnxWholes(std::string_view name, const std::vector<std::int64_t>& values) {
  return OnnxIntegers(name, values);
}

enum class MaskSize { kBox, kInput };

/// What MakeOnnxMaskRcnn varies.
struct OnnxMaskRcnnNetwork {
  MaskSize masks = MaskSize::kInput;
  std::vector<int> input_shape = {3, 0, 0};  ///< 0 = open
  std::int64_t label = 62;
  std::vector<float> box = {8, 4, 40, 24};
  bool has_masks = true;
};

/// A network with one detection in the layout of torchvision (masks of the input's size) or of the
/// ONNX model zoo (28 × 28, 1 in the left half, whatever the image). Its score is the mean of the
/// input's first channel, its mask of the input's size sigmoid(20 · third channel − 10).
inline std::string MakeOnnxMaskRcnn(const OnnxMaskRcnnNetwork& options = {}) {
  std::vector<float> half(28 * 28, 0.0F);
  for (int i = 0; i < 28 * 28; ++i) half[i] = i % 28 < 14 ? 1.0F : 0.0F;
  Message graph;
  const bool batch = options.input_shape.size() == 4;
  if (!batch) graph.Add(1, OnnxNode("Unsqueeze", {"image", "axis"}, "batch"));
  const std::string input = batch ? "image" : "batch";
  graph.Add(1, OnnxConvolution({input, "score_weights", "zero"}, "score_map", 1))
      .Add(1, OnnxNode("GlobalAveragePool", {"score_map"}, "score_mean"))
      .Add(1, OnnxNode("Reshape", {"score_mean", "one"}, "scores"))
      .Add(1, OnnxOutput("box", "boxes"))
      .Add(1, OnnxOutput("label", "labels"));
  if (options.has_masks && options.masks == MaskSize::kInput) {
    graph.Add(1, OnnxConvolution({input, "mask_weights", "mask_bias"}, "mask_logits", 1))
        .Add(1, OnnxNode("Sigmoid", {"mask_logits"}, "masks"));
  } else if (options.has_masks) {
    graph.Add(1, OnnxOutput("half", "masks"));
  }
  graph.Bytes(2, "small")
      .Add(5, OnnxWholes("axis", {0}))
      .Add(5, OnnxWholes("one", {1}))
      .Add(5, OnnxWholes("label", {options.label}))
      .Add(5, OnnxWeights("box", {1, 4}, options.box))
      .Add(5, OnnxWeights("half", {1, 1, 28, 28}, half))
      .Add(5, OnnxWeights("score_weights", {1, 3, 1, 1}, {1, 0, 0}))
      .Add(5, OnnxWeights("zero", {1}, {0}))
      .Add(5, OnnxWeights("mask_weights", {1, 3, 1, 1}, {0, 0, 20}))
      .Add(5, OnnxWeights("mask_bias", {1}, {-10}))
      .Add(11, OnnxTypedValue("image", 1, options.input_shape))
      .Add(12, OnnxTypedValue("boxes", 1, {1, 4}))
      .Add(12, OnnxTypedValue("labels", 7, {1}))
      .Add(12, OnnxTypedValue("scores", 1, {1}));
  if (options.has_masks) graph.Add(12, OnnxTypedValue("masks", 1, {1, 1, 0, 0}));
  return OnnxModel(graph);
}

}  // namespace ofm::test
