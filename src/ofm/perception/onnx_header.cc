#include "ofm/perception/onnx_header.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "ofm/base/error.h"
#include "ofm/perception/protobuf_reader.h"

namespace ofm {
namespace {

/// Field numbers in onnx.proto3.
constexpr std::uint64_t kModelGraph = 7, kGraphInitializer = 5, kGraphInput = 11, kTensorName = 8,
                        kValueName = 1, kValueType = 2, kTypeTensor = 1, kTensorShape = 2,
                        kShapeDimension = 1, kDimensionValue = 1;

OnnxInput ReadInput(std::string_view value_info) {
  OnnxInput input{std::string(FindProtobufBytes(value_info, kValueName)), {}};
  const std::string_view tensor =
      FindProtobufBytes(FindProtobufBytes(value_info, kValueType), kTypeTensor);
  ProtobufReader shape(FindProtobufBytes(tensor, kTensorShape));
  while (const auto field = shape.Next()) {
    if (field->number != kShapeDimension) continue;
    std::int64_t size = 0;
    ProtobufReader dimension(field->bytes);
    while (const auto part = dimension.Next()) {
      if (part->number == kDimensionValue) size = static_cast<std::int64_t>(part->value);
    }
    input.shape.push_back(std::max<std::int64_t>(size, 0));
  }
  return input;
}

std::vector<OnnxInput> ReadGraphInputs(std::string_view graph) {
  std::set<std::string, std::less<>> weights;
  std::vector<OnnxInput> inputs;
  ProtobufReader reader(graph);
  while (const auto field = reader.Next()) {
    if (field->number == kGraphInput) inputs.push_back(ReadInput(field->bytes));
    if (field->number == kGraphInitializer)
      weights.emplace(FindProtobufBytes(field->bytes, kTensorName));
  }
  std::erase_if(inputs, [&](const OnnxInput& input) { return weights.contains(input.name); });
  return inputs;
}

}  // namespace

std::vector<OnnxInput> ReadOnnxInputs(std::span<const char> bytes,
                                      const std::filesystem::path& path) {
  std::vector<OnnxInput> inputs;
  try {
    inputs = ReadGraphInputs(FindProtobufBytes({bytes.data(), bytes.size()}, kModelGraph));
  } catch (const MalformedMessage&) {
    throw Error(path, "is no ONNX network or ends too early; export or copy it again");
  }
  if (inputs.empty()) throw Error(path, "is no ONNX network: it has no input; export it again");
  return inputs;
}

}  // namespace ofm
